// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/plan_extent.hpp"

#include <algorithm>
#include <functional>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>

namespace voxelume {
namespace {

constexpr size_t kMaxCompared = 1024;  // each is compared with all before it: some milliseconds

struct BrickRange {
    glm::dvec3 first, last;
};

BrickRange bricks_of(const VoxelBox& box) {
    const glm::dvec3 edge(kBrickSize);
    return {glm::floor(box.low / edge), glm::max(glm::ceil(box.high / edge) - 1.0, 0.0)};
}

bool are_apart(const BrickRange& a, const BrickRange& b) {
    return glm::any(glm::lessThan(a.last, b.first)) || glm::any(glm::lessThan(b.last, a.first));
}

}  // namespace

WorldExtent min_extent(std::vector<ObjectExtent> objects) {
    std::ranges::stable_sort(objects, std::greater(),
                             [](const ObjectExtent& object) { return object.extent.bricks; });
    objects.resize(std::min(objects.size(), kMaxCompared));
    WorldExtent sum;
    std::vector<BrickRange> taken;
    for (const ObjectExtent& object : objects) {
        const BrickRange range = bricks_of(object.box);
        if (!std::ranges::all_of(taken, [&](const BrickRange& r) { return are_apart(r, range); }))
            continue;
        taken.push_back(range);
        const glm::dvec3 size = glm::max(range.last - range.first + 1.0, 0.0);
        const double bricks = std::min(object.extent.bricks, size.x * size.y * size.z);
        const double maximum = bricks * kBrickSize * kBrickSize * kBrickSize;
        sum.voxels += std::min(object.extent.voxels, maximum);
        sum.bricks += bricks;
        sum.exact_voxels += std::min(object.extent.exact_voxels, maximum);
    }
    return sum;
}

VoxelBox in_part(const VoxelBox& box, const GridFrame& whole, const GridFrame& part) {
    const glm::dvec3 first = (part.origin - whole.origin) / part.voxel_edge;
    return {box.low - first, box.high - first};
}

}  // namespace voxelume
