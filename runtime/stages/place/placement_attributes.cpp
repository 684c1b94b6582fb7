// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/placement_attributes.hpp"

#include <algorithm>
#include <numeric>

#include "kernels/shared/voxel.h"

namespace voxelume {
namespace {

uint32_t attributes_without_material(const PlacedObject& object, Surface surface) {
    return static_cast<uint32_t>(surface) << VXL_KIND_SHIFT | object.object;
}

std::vector<uint32_t> materials_of(const PlacedObject& object) {
    if (!object.material_of_group.empty()) return object.material_of_group;
    std::vector<uint32_t> groups(VXL_MATERIAL_MASK + 1);
    std::iota(groups.begin(), groups.end(), 0u);
    return groups;
}

}  // namespace

AttributeMap attribute_map(const Device& device, const PlacedObject& object, Surface surface) {
    const std::vector<uint32_t> materials = materials_of(object);
    return {.map = {attributes_without_material(object, surface), object.grid->attribute,
                    static_cast<uint32_t>(materials.size()), 0},
            .materials = Buffer<uint32_t>(device, "materials of groups", materials)};
}

std::vector<uint32_t> possible_attributes(const PlacedObject& object, Surface surface) {
    std::vector<uint32_t> materials = materials_of(object);
    const BrickGrid& grid = *object.grid;
    if (grid.attributes.empty() && grid.triangle_attributes.empty() && grid.solids.empty()) {
        const uint32_t group = grid.attribute >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK;
        materials = {materials[std::min<size_t>(group, materials.size() - 1)]};
    }
    for (uint32_t& material : materials)
        material = attributes_without_material(object, surface) | material << VXL_MATERIAL_SHIFT;
    return materials;
}

}  // namespace voxelume
