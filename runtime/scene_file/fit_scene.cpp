// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene_file/fit_scene.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <map>
#include <stdexcept>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"
#include "runtime/scene/moved_part.hpp"
#include "runtime/scene/scene_animation.hpp"

namespace voxelume {
namespace {

bool is_empty(const Bounds& box) {
    return !(box.min.x <= box.max.x && box.min.y <= box.max.y && box.min.z <= box.max.z);
}

void add(const Bounds& more, Bounds& box) {
    box = {glm::min(box.min, more.min), glm::max(box.max, more.max)};
}

/// The box around another one after a map.
Bounds mapped(const glm::dmat4& map, const Bounds& box) {
    Bounds result = kEmptyBounds;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 p(map * glm::dvec4(corner(box, i), 1));
        add({p, p}, result);
    }
    return result;
}

/// Collects the boxes of a scene's objects, frame by frame.
class ObjectsBox {
  public:
    ObjectsBox(const Scene& scene, const SceneMotion& motion, const FileBoxes& file_boxes)
        : now_(scene),
          motion_(motion),
          file_boxes_(file_boxes),
          object_moves_(scene.objects.size(), false),
          model_moves_(scene.models.size(), false) {}

    /// The box around all frames; empty where nothing has one.
    Bounds find() {
        std::vector<const MovingPart*> parts;
        for (const MovingPart& part : motion_.parts) {
            if (part.part == ScenePart::object) object_moves_[part.index] = true;
            if (part.part == ScenePart::model) model_moves_[part.index] = true;
            if (part.part == ScenePart::object || part.part == ScenePart::model)
                parts.push_back(&part);
        }
        const int frames = parts.empty() ? 1 : now_.animation.frames;
        for (int frame = 1; frame <= frames; ++frame) add_frame(frame, parts);
        return box_;
    }

    /// The reason why the box is empty.
    std::string reason() const {
        if (now_.objects.empty()) return "there are no objects";
        return saw_infinite_ ? "all visible objects are infinite, such as a slab"
                             : "no object is visible in any frame";
    }

  private:
    void add_frame(int frame, const std::vector<const MovingPart*>& parts) {
        try {
            for (const MovingPart* part : parts)
                MovedPart(*part, motion_.file, frame, now_).apply();
        } catch (const Error& error) {
            throw at_frame(error, frame);
        }
        for (size_t i = 0; i < now_.objects.size(); ++i) {
            const Object& object = now_.objects[i];
            if (frame > 1 && !object_moves_[i] && !model_moves_[size_t(object.model)]) continue;
            if (object.visible) add_object(object, frame == 1);
        }
    }

    void add_object(const Object& object, bool is_first) {
        const Model& model = now_.models[size_t(object.model)];
        if (!model.solid) {
            add(mapped(object.world_from_object, file_model_box(model, is_first)), box_);
        } else if (is_infinite(*model.solid)) {
            saw_infinite_ = true;
        } else {
            const SolidBounds box = bounds(*model.solid, object.world_from_object);
            if (!box.is_empty()) add({box.min, box.max}, box_);
        }
    }

    /// The box in object space. The box of a morphing mesh is interpolated between the boxes of its
    /// two shapes.
    Bounds file_model_box(const Model& model, bool is_first) {
        // The file's box contains all positions under the weights, and changes with them.
        if (model.morph && model.morph->is_of_file())
            return model.object_from_file(file_boxes_(model, is_first));
        const Bounds box = model.object_from_file(file_box(model, is_first));
        if (!model.morph) return box;
        const Morph& morph = *model.morph;
        Bounds end{morph.center - morph.radius, morph.center + morph.radius};
        if (!morph.mesh.empty()) {
            Model at_end = model;
            at_end.mesh = morph.mesh;
            end = model.object_from_file(file_box(at_end, is_first));
        }
        return {glm::mix(box.min, end.min, morph.amount), glm::mix(box.max, end.max, morph.amount)};
    }

    const Bounds& file_box(const Model& model, bool is_first) {
        const std::pair source(model.voxels.empty() ? model.mesh : model.voxels, model.part);
        const auto found = known_.find(source);
        if (found != known_.end()) return found->second;
        return known_.emplace(source, file_boxes_(model, is_first)).first->second;
    }

    Scene now_;
    const SceneMotion& motion_;
    const FileBoxes& file_boxes_;
    std::vector<bool> object_moves_, model_moves_;
    std::map<std::pair<std::filesystem::path, int>, Bounds> known_;  ///< by file and part
    Bounds box_ = kEmptyBounds;
    bool saw_infinite_ = false;
};

/// The part of the objects' box that the world shows, or all of the world if that is empty.
Bounds shown_box(const Bounds& objects, const World& world) {
    const Bounds lattice = lattice_bounds(world);
    const Bounds common{glm::max(objects.min, lattice.min), glm::min(objects.max, lattice.max)};
    return is_empty(common) || !(longest_side(common) > 0) ? lattice : common;
}

}  // namespace

void fit_models(const FileBoxes& boxes, Scene& scene) {
    for (Model& model : scene.models) {
        if (model.fit == 0) continue;
        const Bounds box = boxes(model, true);
        const double longest = longest_side(box);
        if (!(longest > 0))
            throw Error(ErrorKind::scene,
                        "{}: all of the file is one point, which can't be fitted to a size; leave "
                        "out \"fit\"",
                        model.where);
        const double scale = model.fit / longest;
        model.object_from_file = {scale, -scale * ((box.min + box.max) / 2.0)};
    }
}

void fit_to_objects(const SceneMotion& motion, const FileBoxes& boxes, Scene& scene) {
    World& world = scene.world;
    if (scene.fitted.bounds || scene.fitted.observer) {
        ObjectsBox collected(scene, motion, boxes);
        const Bounds objects = collected.find();
        if (scene.fitted.bounds) {
            if (is_empty(objects))
                throw Error(ErrorKind::scene,
                            "{}: {}, so nothing tells how large the world is; give it \"bounds\": "
                            "{{\"min\": [x, y, z], \"max\": [x, y, z]}}",
                            world.where, collected.reason());
            fit_lattice(objects, world);
        }
        scene.fitted.shown = shown_box(objects, world);
    }
    for (Model& model : scene.models)
        if (model.voxels.empty() && model.resolution == 0 && model.voxel_size.x == 0)
            model.voxel_size = world.voxel_size;
}

}  // namespace voxelume
