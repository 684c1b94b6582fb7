// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/read_motion.hpp"

#include <algorithm>
#include <map>

#include "runtime/scene_file/document_part.hpp"

namespace voxelume {
namespace {

/// The index of a part in the scene's list; a material's index differs from that in the document.
size_t index_of_part(const DocumentPart& part, const Scene& scene) {
    if (part.part != ScenePart::material) return part.number;
    return size_t(std::ranges::find(scene.materials, part.name, &Material::name) -
                  scene.materials.begin());
}

const JsonMember* find_member(const JsonValue& value, std::string_view key) {
    const auto found = std::ranges::find(value.members, key, &JsonMember::key);
    return found == value.members.end() ? nullptr : &*found;
}

/// True if one of two targets of a part equals the other, or is a component of it.
bool overlap(const TrackTarget& a, const TrackTarget& b) {
    const size_t shared = std::min(a.steps.size(), b.steps.size());
    return std::equal(a.steps.begin(), a.steps.begin() + std::ptrdiff_t(shared), b.steps.begin());
}

bool is_placement(const DocumentTrack& track) {
    const std::string& key = track.target.steps.front().key;
    return key == "parents" || find_row(factor_rows(), key) != nullptr;
}

/// Collects moving parts, one entry per part of the scene.
class MotionReader {
  public:
    explicit MotionReader(const SceneValue& root) : root_(root) {}

    void add_track(DocumentTrack track, const SceneValue& value) {
        DocumentPart& part = part_of(track.target);
        for (const DocumentTrack& other : part.tracks) {
            if (overlap(other.target, track.target))
                SceneFields(value, "track")
                    .get("target")
                    .fail("another track changes this value already: " + other.where.text());
        }
        part.tracks.push_back(std::move(track));
    }

    /// Adds models and a density whose files are numbered.
    void add_sequences() {
        if (const JsonMember* models = find_member(root_.json(), "models")) {
            for (size_t i = 0; i < models->value.members.size(); ++i) {
                const JsonMember& model = models->value.members[i];
                if (find_member(model.value, "sequence") == nullptr) continue;
                part_of({ScenePart::model, i, model.key, "models." + model.key, &model.value, {}});
            }
        }
        const JsonMember* member = find_member(root_.json(), "world");
        if (member == nullptr) return;
        const JsonValue *world = &member->value, *at = world;
        for (const std::string_view key : {"medium", "density", "sequence"}) {
            const JsonMember* inner = find_member(*at, key);
            if (inner == nullptr) return;
            at = &inner->value;
        }
        part_of({ScenePart::world, 0, "", "world", world, {}});
    }

    std::vector<DocumentPart> finish(Scene& scene) {
        std::vector<DocumentPart> parts;
        for (auto& [key, part] : parts_) {
            part.index = index_of_part(part, scene);
            if (part.part == ScenePart::object) {
                scene.objects[part.index].moves = std::ranges::any_of(part.tracks, is_placement);
                part.only_placed = std::ranges::all_of(part.tracks, is_placement);
            }
            parts.push_back(std::move(part));
        }
        return parts;
    }

  private:
    DocumentPart& part_of(const TrackTarget& target) {
        const auto [found, is_new] = parts_.try_emplace({target.part, target.number});
        if (is_new)
            found->second = {.part = target.part,
                             .number = target.number,
                             .index = 0,
                             .name = target.name,
                             .path = target.path,
                             .value = target.value,
                             .tracks = {}};
        return found->second;
    }

    const SceneValue& root_;
    std::map<std::pair<ScenePart, size_t>, DocumentPart> parts_;
};

}  // namespace

std::vector<DocumentPart> moving_parts(const SceneValue& root, Scene& scene) {
    MotionReader reader(root);
    const SceneFields fields(root, "scene");
    if (const auto animation = fields.find("animation")) {
        if (const auto tracks = SceneFields(*animation, "animation").find("tracks")) {
            for (const SceneValue& value : tracks->items())
                reader.add_track(read_track(value, root.json(), scene.animation.fps), value);
        }
    }
    reader.add_sequences();
    return reader.finish(scene);
}

void add_part(const DocumentPart& part, const AssetSearch& search, const Scene& scene,
              SceneMotion& motion) {
    check_keys(part, scene, search);
    motion.parts.push_back(moving_part(part, scene, search));
}

}  // namespace voxelume
