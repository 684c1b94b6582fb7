// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/document_part.hpp"

namespace voxelume {
namespace {

/// The members of an object's placement, or all others.
JsonValue members_of(const JsonValue& object, bool is_placement) {
    static constexpr std::string_view kKeys[] = {"position", "turn", "scale", "matrix", "parents"};
    JsonValue members;
    members.type = object.type;
    members.at = object.at;
    for (const JsonMember& member : object.members)
        if ((std::ranges::find(kKeys, member.key) != std::end(kKeys)) == is_placement)
            members.members.push_back(member);
    return members;
}

/// Reads a part only for its messages.
class PartCheck {
  public:
    PartCheck(const DocumentPart& part, const Scene& scene, const AssetSearch& search)
        : part_(part),
          scene_(scene),
          search_{search.scene_folder, search.assets, false},
          file_(scene.file.string()),
          // Only few members are copied for each key of thousands of objects.
          value_(part.only_placed ? members_of(*part.value, true) : *part.value) {}

    void check(double frame) {
        try {
            JsonValue value = value_;
            for (const DocumentTrack& track : part_.tracks) {
                if (may_be_flat(track, frame)) continue;
                put_value(value, track.target.steps, value_at(track, frame));
            }
            read(SceneValue(value, part_.path, file_));
        } catch (const Error& error) {
            throw at_frame(error, frame);
        }
    }

  private:
    /// True if the track is the scale of an object, which may pass 0 between keys.
    bool may_be_flat(const DocumentTrack& track, double frame) const {
        if (part_.part != ScenePart::object) return false;
        const auto is_scale = [](const PathStep& step) { return step.key == "scale"; };
        return std::ranges::any_of(track.target.steps, is_scale) &&
               std::ranges::find(track.keys.frames, frame) == track.keys.frames.end();
    }
    void read(const SceneValue& value) {
        switch (part_.part) {
            case ScenePart::world:
                read_world(value, search_);
                return;
            case ScenePart::material:
                read_material(part_.name, value);
                return;
            case ScenePart::model:
                read_model(part_.name, value, {search_, scene_.world.voxel_size});
                return;
            case ScenePart::object:
                // A map that flattens an object between keys, or together with its parents, only
                // hides it.
                read_links(SceneFields(value, "object"));
                if (!part_.only_placed) {
                    const JsonValue rest = members_of(value.json(), false);
                    ObjectReader(scene_).read(SceneValue(rest, part_.path, file_), part_.index);
                }
                return;
            case ScenePart::light:
                read_light(value, part_.index);
                return;
            case ScenePart::observer:
                read_observer(value, scene_);
                return;
        }
    }

    const DocumentPart& part_;
    const Scene& scene_;
    AssetSearch search_;
    std::string file_;
    JsonValue value_;
};

}  // namespace

void check_keys(const DocumentPart& part, const Scene& scene, const AssetSearch& search) {
    PartCheck check(part, scene, search);
    for (const DocumentTrack& track : part.tracks)
        for (const double frame : track.keys.frames) check.check(frame);
    check.check(1);
}

}  // namespace voxelume
