// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/scene.hpp"

#include <array>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/error.hpp"
#include "runtime/scene/predicates.hpp"

namespace voxelume {

void find_extents(Scene& scene) {
    const Bounds world = lattice_bounds(scene.world);
    std::array<glm::dvec4, 8> corners;
    for (int i = 0; i < 8; ++i) corners[size_t(i)] = glm::dvec4(corner(world, i), 1);
    for (Model& model : scene.models) model.extent = {};
    std::vector<bool> is_used(scene.models.size(), false), is_baked(scene.models.size(), false);
    const auto baked = [&](const Object& object) { return !is_instanced(scene, object); };
    for (const Object& object : scene.objects)
        if (object.visible && baked(object)) is_baked[object.model] = true;
    for (const Object& object : scene.objects) {
        // Placements of instances don't matter to models that are shown in the world.
        if (!object.visible || (is_baked[object.model] && !baked(object))) continue;
        const glm::dmat4 object_from_world = glm::inverse(object.world_from_object);
        Bounds& extent = scene.models[object.model].extent;
        for (const glm::dvec4& world_corner : corners) {
            const glm::dvec3 p(object_from_world * world_corner);
            const bool is_first = !is_used[object.model];
            extent.min = is_first ? p : glm::min(extent.min, p);
            extent.max = is_first ? p : glm::max(extent.max, p);
            is_used[object.model] = true;
        }
    }
}

void resize(Scene& scene, glm::ivec2 size) {
    if (size.x < 1 || size.y < 1 || size.x > kMaxImageSide || size.y > kMaxImageSide) {
        throw Error(ErrorKind::usage, "an image has from 1 to {} pixels on a side, not {}x{}",
                    kMaxImageSide, size.x, size.y);
    }
    scene.render.size = size;
    scene.render.crop = {};
    if (scene.fitted.observer) return frame_observer(scene);
    make_pixels_square(proportions(scene.render), scene.observer.display);
}

void check_tiles(const RenderSettings& render) {
    const ImageCrop& crop = render.crop;
    if (!render.noise.is_given() || crop.is_whole()) return;
    for (int axis = 0; axis < 2; ++axis) {
        const int first = crop.first[axis], end = first + render.size[axis];
        if (first % 4 != 0 || (end % 4 != 0 && end != crop.frame[axis]))
            throw Error(ErrorKind::usage,
                        "noise is measured in 4 x 4 pixels of the whole image: a part of it must "
                        "begin and end at multiples of 4 or at the image's edge, unlike {}x{} "
                        "pixels from column {} and row {} on",
                        render.size.x, render.size.y, crop.first.x, crop.first.y);
    }
}

void crop(Scene& scene, glm::ivec2 first, glm::ivec2 size) {
    const glm::ivec2 frame = frame_size(scene.render);
    for (int axis = 0; axis < 2; ++axis) {
        const bool is_inside = first[axis] >= 0 && size[axis] >= 1 && first[axis] < frame[axis] &&
                               size[axis] <= frame[axis] - first[axis];
        if (!is_inside)
            throw Error(ErrorKind::usage,
                        "{}x{} pixels from column {} and row {} on don't lie in a picture of {}x{}",
                        size.x, size.y, first.x, first.y, frame.x, frame.y);
    }
    scene.render.crop = {first, frame};
    scene.render.size = size;
    check_tiles(scene.render);
}

}  // namespace voxelume
