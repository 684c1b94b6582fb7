// SPDX-License-Identifier: Apache-2.0
#include "runtime/render/shown_content.hpp"

#include <cmath>
#include <functional>

namespace voxelume {
namespace {

/// Looks at `count` pixels or voxels until both flags are known.
template <class ShowsObject, class IsLit>
ShownContent content_at(size_t count, const ShowsObject& shows_object, const IsLit& is_lit) {
    ShownContent content{false, false};
    for (size_t i = 0; i < count && !content.light; ++i) {
        if (!shows_object(i)) continue;
        content.objects = true;
        content.light = is_lit(i);
    }
    if (!content.objects) content.light = true;  // without objects the light is unknown
    return content;
}

const Plane<float>* plane_of(const Image& image, const char* name) {
    const auto found = image.planes.find(name);
    return found == image.planes.end() ? nullptr : &found->second;
}

}  // namespace

ShownContent content_of(const Image& image) {
    const Plane<float>*r = plane_of(image, "R"), *g = plane_of(image, "G"),
          *b = plane_of(image, "B"), *a = plane_of(image, "A"), *z = plane_of(image, "Z");
    if (!z && !a) return {};
    const size_t count = size_t(image.width) * size_t(image.height);
    return content_at(
        count, [&](size_t i) { return z ? std::isfinite((*z)[i]) : (*a)[i] > 0; },
        [&](size_t i) { return !r || (*r)[i] != 0 || (*g)[i] != 0 || (*b)[i] != 0; });
}

ShownContent content_of(const Volume& volume) {
    return content_at(
        volume.indices.size(), [&](size_t i) { return volume.kinds[i] == VoxelKind::object; },
        [&](size_t i) { return volume.colors[i] != glm::vec3(0); });
}

}  // namespace voxelume
