// SPDX-License-Identifier: Apache-2.0
#include "runtime/grid/grid_arguments.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/vec4.hpp>

#include "kernels/shared/solid.h"

namespace voxelume {

PyramidShape shape_of(const Pyramid& pyramid) {
    const GridFrame& frame = pyramid.frame;
    const int longest = std::max({frame.size.x, frame.size.y, frame.size.z});
    // Coordinates 0 .. longest need integer_bits; the rest of a float's 24 bits is fraction, so
    // that every coordinate is an exact float and its fixed-point integer an exact float too.
    const int integer_bits = std::bit_width(static_cast<unsigned>(longest));
    PyramidShape shape{};
    const glm::dvec3& edge = frame.voxel_edge;
    shape.edge = {float(edge.x), float(edge.y), float(edge.z), 0};
    shape.inverse_edge = {float(1 / edge.x), float(1 / edge.y), float(1 / edge.z), 0};
    shape.size_x = frame.size.x;
    shape.size_y = frame.size.y;
    shape.size_z = frame.size.z;
    shape.sectors_x = frame.sectors().x;
    shape.sectors_y = frame.sectors().y;
    // t = (K - o) (1/d) has two roundings of half a unit, o + d t one more: together less than
    // 2.5 * 2^-24 of the longest side; 4 units leave room for the comparison's own rounding.
    shape.plane_bound = std::ldexp(1.0f, integer_bits + 2 - 24);
    shape.fixed_point = std::ldexp(1.0f, 24 - integer_bits);
    shape.origin_offset = pyramid.instances.origin_offset;
    return shape;
}

void bind(KernelArguments& to, const BrickGrid& grid) {
    to.add(glm::ivec4(grid.frame.size, 0), glm::ivec4(grid.frame.bricks(), 0), grid.slots,
           grid.coordinates, grid.occupancy, grid.distance, grid.attributes, grid.attribute,
           grid.colors, grid.normals, grid.primitive_first, grid.primitives);
}

void bind(KernelArguments& to, const Pyramid& pyramid) {
    to.add(shape_of(pyramid), pyramid.sectors, pyramid.bricks, pyramid.leaves, pyramid.leaf_voxels,
           pyramid.attributes, pyramid.attribute, pyramid.colors, pyramid.normals, pyramid.fields,
           pyramid.primitive_first, pyramid.primitives, pyramid.triangles,
           pyramid.triangle_attributes, pyramid.triangle_normals, pyramid.triangle_textures,
           pyramid.textures, pyramid.solids, uint32_t(pyramid.solids.size() / VXL_SOLID_WORDS),
           pyramid.order, pyramid.instances.records, pyramid.instances.nodes,
           pyramid.instances.materials);
}

}  // namespace voxelume
