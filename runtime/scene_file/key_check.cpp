// SPDX-License-Identifier: Apache-2.0
#include <algorithm>

#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/document_part.hpp"

namespace voxelume {
namespace {

/// What places the object of a part: little is copied for each key of thousands of objects.
JsonValue placement_of(const JsonValue& object) {
    static constexpr std::string_view kKeys[] = {"position", "turn", "scale", "matrix", "parents"};
    JsonValue placement;
    placement.type = object.type;
    placement.at = object.at;
    for (const JsonMember& member : object.members)
        if (std::ranges::find(kKeys, member.key) != std::end(kKeys))
            placement.members.push_back(member);
    return placement;
}

/// Reads a part and keeps nothing but the messages.
class PartCheck {
  public:
    PartCheck(const DocumentPart& part, const Scene& scene, const AssetSearch& search)
        : part_(part),
          scene_(scene),
          search_{search.scene_folder, search.assets, false},
          file_(scene.file.string()),
          value_(part.only_placed ? placement_of(*part.value) : *part.value) {}

    void check(double frame) {
        try {
            JsonValue value = value_;
            for (const DocumentTrack& track : part_.tracks)
                put_value(value, track.target.steps, value_at(track, frame));
            read(SceneValue(value, part_.path, file_));
        } catch (const Error& error) {
            throw at_frame(error, frame);
        }
    }

  private:
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
                if (part_.only_placed) {
                    read_object_place(SceneFields(value, "object"));
                } else {
                    ObjectReader(scene_).read(value, part_.place);
                }
                return;
            case ScenePart::light:
                read_light(value, part_.place);
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
