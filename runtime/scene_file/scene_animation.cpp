#include "runtime/scene_file/scene_animation.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "runtime/scene_file/scene_motion.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

/// Reads parts as they are at one frame into a scene.
class FrameReader {
  public:
    FrameReader(Scene& scene, const SceneMotion& motion, double frame, bool all_files)
        : scene_(scene),
          motion_(motion),
          frame_(frame),
          search_{scene.file.parent_path(), motion.assets, frame, all_files} {}

    void read(const MovingPart& part) {
        if (part.factors && place(part)) return;
        try {
            JsonValue json = part.value;
            for (const Track& track : part.tracks)
                put_value(json, track.target.steps, value_at(track, frame_));
            read(part, SceneValue(json, part.path, motion_.file));
        } catch (const Error& error) {
            throw at_frame(error, frame_);
        }
    }

  private:
    /// Places an object without the detour over the document, which has the messages: worlds have
    /// thousands of objects on the move. Keys are in their ranges, and so is what lies between.
    bool place(const MovingPart& part) {
        Factors factors = *part.factors;
        for (const Track& track : part.tracks) {
            const std::vector<double> row = values_at(track.keys, frame_);
            const std::string& key = track.target.steps.front().key;
            glm::dvec3& factor = key == "position" ? factors.position
                                 : key == "turn"   ? factors.turn
                                                   : factors.scale;
            factor = row.size() == 1 ? glm::dvec3(row[0]) : glm::dvec3(row[0], row[1], row[2]);
        }
        const glm::dmat4 map = affine_from_factors(factors);
        if (!is_safely_invertible(stretch_of(glm::dmat3(map)))) return false;
        scene_.objects[part.place].world_from_object = map;
        return true;
    }

    void read(const MovingPart& part, const SceneValue& value) {
        switch (part.part) {
            case ScenePart::world:
                return read_space(value);
            case ScenePart::material:
                scene_.materials[part.place] = read_material(part.name, value);
                return;
            case ScenePart::model:
                return read_shape(part, value);
            case ScenePart::object:
                return read_object(part, value);
            case ScenePart::light:
                scene_.lights[part.place] = read_light(value, part.place);
                return;
            case ScenePart::observer:
                return read_view(value);
        }
    }

    void read_space(const SceneValue& value) {
        World world = read_world(value, search_);
        scene_.world.background = world.background;
        scene_.world.ambient = world.ambient;
        scene_.world.medium = std::move(world.medium);
    }

    void read_shape(const MovingPart& part, const SceneValue& value) {
        Model& model = scene_.models[part.place];
        Model now = read_model(part.name, value, {search_, scene_.world.voxel_size});
        model.mesh = std::move(now.mesh);
        model.voxels = std::move(now.voxels);
        model.solid = std::move(now.solid);
        model.morph = std::move(now.morph);
        model.cuts = std::move(now.cuts);
    }

    void read_object(const MovingPart& part, const SceneValue& value) {
        Object& object = scene_.objects[part.place];
        if (part.places) {
            object.world_from_object = read_placement(SceneFields(value, "object"));
            return;
        }
        if (!objects_) objects_.emplace(scene_);
        const bool moves = object.moves, potentially_visible = object.potentially_visible;
        object = objects_->read(value, part.place);
        object.moves = moves;
        object.potentially_visible = potentially_visible;
    }

    void read_view(const SceneValue& value) {
        Observer observer = ::voxelume::read_observer(value, scene_);
        const Display& before = scene_.observer.display;
        observer.display.voxels = before.voxels;
        observer.display.layout = before.layout;
        observer.display.visibility = before.visibility;
        observer.display.cylinder = before.cylinder;
        scene_.observer = observer;
    }

    Scene& scene_;
    const SceneMotion& motion_;
    double frame_;
    AssetSearch search_;
    std::optional<ObjectReader> objects_;
};

/// Where the scene's list has the part; a material's place is not that in the document.
size_t place_of(const MovingPart& part, const Scene& scene) {
    if (part.part != ScenePart::material) return part.number;
    return size_t(std::ranges::find(scene.materials, part.name, &Material::name) -
                  scene.materials.begin());
}

const JsonMember* find_member(const JsonValue& value, std::string_view key) {
    const auto found = std::ranges::find(value.members, key, &JsonMember::key);
    return found == value.members.end() ? nullptr : &*found;
}

/// Whether one of two targets of a part is the other, or a number of it.
bool overlap(const TrackTarget& a, const TrackTarget& b) {
    const size_t shared = std::min(a.steps.size(), b.steps.size());
    return std::equal(a.steps.begin(), a.steps.begin() + std::ptrdiff_t(shared), b.steps.begin());
}

bool is_placement(const Track& track) {
    static constexpr std::string_view kFactors[] = {"position", "turn", "scale"};
    return std::ranges::find(kFactors, track.target.steps.front().key) != std::end(kFactors);
}

/// Collects what moves, one entry per part of the scene.
class MotionReader {
  public:
    MotionReader(const SceneValue& root, const AssetFolders& assets) : root_(root) {
        motion_.assets = assets;
    }

    void add_track(Track track, const SceneValue& value) {
        MovingPart& part = part_of(track.target);
        for (const Track& other : part.tracks) {
            if (overlap(other.target, track.target))
                SceneFields(value, "track")
                    .get("target")
                    .fail("another track changes this value already: " + other.where);
        }
        part.tracks.push_back(std::move(track));
    }

    /// Models and a density whose files are numbered.
    void add_sequences() {
        if (const JsonMember* models = find_member(root_.json(), "models")) {
            for (size_t i = 0; i < models->value.members.size(); ++i) {
                const JsonMember& model = models->value.members[i];
                if (find_member(model.value, "sequence") == nullptr) continue;
                part_of({ScenePart::model, i, model.key, "models." + model.key, &model.value, {}});
            }
        }
        const JsonValue* world = &find_member(root_.json(), "world")->value;
        const JsonValue* at = world;
        for (const std::string_view key : {"medium", "density", "sequence"}) {
            const JsonMember* inner = find_member(*at, key);
            if (inner == nullptr) return;
            at = &inner->value;
        }
        part_of({ScenePart::world, 0, "", "world", world, {}});
    }

    SceneMotion finish(Scene& scene) {
        for (auto& [key, part] : parts_) {
            part.place = place_of(part, scene);
            if (part.part == ScenePart::object) finish_object(part, scene.objects[part.place]);
            motion_.parts.push_back(std::move(part));
        }
        return std::move(motion_);
    }

  private:
    MovingPart& part_of(const TrackTarget& target) {
        const auto [found, is_new] = parts_.try_emplace({target.part, target.number});
        if (is_new)
            found->second = {target.part,   target.number, 0,  target.name, target.path,
                             *target.value, false,         {}, {}};
        return found->second;
    }

    /// An object that is only placed anew keeps what else places it, so that little is copied.
    static void finish_object(MovingPart& part, Object& object) {
        object.moves = std::ranges::any_of(part.tracks, is_placement);
        part.places = std::ranges::all_of(part.tracks, is_placement);
        if (!part.places) return;
        std::erase_if(part.value.members, [&](const JsonMember& m) {
            const bool is_replaced = std::ranges::any_of(part.tracks, [&](const Track& track) {
                return track.target.steps == std::vector<TargetStep>{{m.key}};
            });
            return is_replaced || (m.key != "position" && m.key != "turn" && m.key != "scale" &&
                                   m.key != "matrix");
        });
    }

    const SceneValue& root_;
    SceneMotion motion_;
    std::map<std::pair<ScenePart, size_t>, MovingPart> parts_;
};

/// Finds the factors of an object that no track changes, if all tracks change whole ones.
void find_factors(MovingPart& part, const std::string& file) {
    const SceneValue value(part.value, part.path, file);
    const bool by_factors = part.places && std::ranges::all_of(part.tracks, [](const Track& track) {
                                return track.target.steps.size() == 1;
                            });
    if (!by_factors) return;
    const SceneFields fields(value, "object");
    if (!fields.has("matrix")) part.factors = read_factors(fields);
}

/// Reads every part at each of its own keys; between them only relations of values can go wrong.
void check_keys(const Scene& scene, const SceneMotion& motion) {
    Scene trial = scene;
    for (const MovingPart& part : motion.parts) {
        for (const Track& track : part.tracks) {
            for (const double frame : track.keys.frames)
                FrameReader(trial, motion, frame, false).read(part);
        }
        FrameReader(trial, motion, 1, true).read(part);
    }
}

}  // namespace

std::shared_ptr<const SceneMotion> read_motion(const SceneValue& root, const AssetFolders& assets,
                                               Scene& scene) {
    MotionReader reader(root, assets);
    const SceneFields fields(root, "scene");
    if (const auto animation = fields.find("animation")) {
        if (const auto tracks = SceneFields(*animation, "animation").find("tracks")) {
            for (const SceneValue& value : tracks->items())
                reader.add_track(read_track(value, root.json(), scene.animation.fps), value);
        }
    }
    reader.add_sequences();
    auto motion = std::make_shared<SceneMotion>(reader.finish(scene));
    if (motion->parts.empty()) return nullptr;
    motion->file = scene.file.string();
    check_keys(scene, *motion);
    for (MovingPart& part : motion->parts) find_factors(part, motion->file);
    return motion;
}

bool moves(const Scene& scene) {
    return scene.motion != nullptr;
}

Error at_frame(const Error& error, double frame) {
    const std::string sentence = error.what(), end = fmt::format(" (at frame {})", frame);
    return {error.kind(), sentence.ends_with(end) ? sentence : sentence + end};
}

Scene scene_at(const Scene& scene, double frame) {
    Scene now = scene;
    if (!moves(scene)) return now;
    FrameReader reader(now, *scene.motion, frame, false);
    for (const MovingPart& part : scene.motion->parts) reader.read(part);
    find_extents(now);
    return now;
}

}  // namespace voxelume
