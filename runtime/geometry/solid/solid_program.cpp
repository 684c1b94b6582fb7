// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_program.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <glm/vec4.hpp>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/geometry/solid/shape_map.hpp"
#include "runtime/geometry/solid/solid_bounds.hpp"

namespace voxelume {
namespace {

constexpr double kFarthestCentre = 16777216.0;  // in voxels; below it float holds every integer

/// Stores the map from the grid's voxels into shape space, split into parts as in SolidShape.
void store_map(SolidShape& record, const ShapeMap& map, const glm::dmat4& frame_from_shape,
               const GridFrame& frame, double shortest_edge) {
    const glm::dvec3 centre = (glm::dvec3(frame_from_shape[3]) - frame.origin) / frame.voxel_edge;
    for (int axis = 0; axis < 3; ++axis) {
        if (!(std::abs(centre[axis]) <= kFarthestCentre))
            throw Error(
                ErrorKind::limit,
                "an analytic solid's centre lies {:.3g} voxels from its grid, at most {:.0f} "
                "are possible: use larger voxels or move the solid closer",
                std::abs(centre[axis]), kFarthestCentre);
        record.cell[axis] = static_cast<int>(std::floor(centre[axis]));
        record.fraction[axis] = static_cast<float>(centre[axis] - std::floor(centre[axis]));
        const double scale = frame.voxel_edge[axis] / shortest_edge;
        for (int row = 0; row < 3; ++row)
            record.shape_from_grid[3 * row + axis] =
                static_cast<float>(map.shape_from_frame[axis][row] * scale);
    }
}

/// Stores a bound of what float evaluation loses: 6 roundings on the way into shape space and 8 in
/// the distance. Each is 2^-24 of lengths up to the point's and the shape's, times sqrt(3) for
/// three coordinates. An ellipsoid's roundings grow with its eccentricity.
void store_rounding(SolidShape& record, const ShapeMap& map) {
    const float* m = record.shape_from_grid;
    float largest = 0;
    for (int i = 0; i < 9; ++i) largest = std::max(largest, std::abs(m[i]));
    double factor = 32 * std::ldexp(1.0, -24);
    if (map.kind == SolidKind::ellipsoid)
        factor *= std::max({map.size[0], map.size[1], map.size[2]}) /
                  std::min({map.size[0], map.size[1], map.size[2]});
    const double sizes = map.size[0] + map.size[1] + map.size[2];
    record.rounding[0] = static_cast<float>(factor * largest);
    record.rounding[1] = static_cast<float>(factor * (largest + sizes));
}

void store_derived(SolidShape& record, const ShapeMap& map) {
    glm::dvec4 derived{0};
    if (map.kind == SolidKind::cone) {
        const double height = 2 * map.size[1], inwards = map.size[0] - map.size[2];
        const double length = std::hypot(height, inwards);
        derived = {height / length, inwards / length, -inwards / (length * length),
                   height / (length * length)};
        record.derived[4] = static_cast<float>(-inwards / height);
    } else if (map.kind == SolidKind::ellipsoid) {
        const double shortest = std::min({map.size[0], map.size[1], map.size[2]});
        derived = glm::dvec4(map.size, 1) / shortest;
        record.size[3] = static_cast<float>(shortest);
    }
    for (int i = 0; i < 4; ++i) record.derived[i] = static_cast<float>(derived[i]);
}

SolidShape device_shape(const Solid& solid, const glm::dmat4& frame_from_shape,
                        const GridFrame& frame, bool is_complement) {
    const double shortest_edge =
        std::min({frame.voxel_edge.x, frame.voxel_edge.y, frame.voxel_edge.z});
    const ShapeMap map = map_shape(solid, glm::dmat3(frame_from_shape) * (1.0 / shortest_edge));
    SolidShape record{};
    record.kind = static_cast<uint32_t>(map.kind) | (is_complement ? VXL_SOLID_COMPLEMENT : 0u);
    store_map(record, map, frame_from_shape, frame, shortest_edge);
    for (int i = 0; i < 3; ++i) record.size[i] = static_cast<float>(map.size[i]);
    store_derived(record, map);
    store_rounding(record, map);
    return record;
}

SourceShape source_shape(const Solid& solid, const glm::dmat4& frame_from_shape,
                         const GridFrame& frame, bool is_complement) {
    SourceShape source;
    source.solid = solid;
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(frame_from_shape));
    for (int axis = 0; axis < 3; ++axis)
        source.linear[axis] = inverse[axis] * frame.voxel_edge[axis];
    source.offset = inverse * (frame.origin - glm::dvec3(frame_from_shape[3]));
    source.is_complement = is_complement;
    return source;
}

/// The radius of the ball around a shape, in its own space.
double radius_of(const SolidShape& shape) {
    const auto [x, y, z, unused] = shape.size;
    switch (shape.kind & VXL_SOLID_KIND_MASK) {
        case VXL_SOLID_SPHERE:
            return x;
        case VXL_SOLID_ELLIPSOID:
            return std::max({x, y, z});
        case VXL_SOLID_BOX:
            return std::hypot(x, y, z);
        case VXL_SOLID_CYLINDER:
            return std::hypot(x, y);
        case VXL_SOLID_CONE:
            return std::hypot(std::max(x, z), y);
        case VXL_SOLID_TORUS:
        case VXL_SOLID_CAPSULE:
            return x + y;
        default:
            return INFINITY;
    }
}

/// SolidShape::reach of a solid whose program is `shapes`.
float reach_of(const Solid& solid, const glm::dmat4& frame_from_solid, const GridFrame& frame,
               const std::vector<SolidShape>& shapes) {
    const SolidShape& first = shapes.front();
    const glm::dvec3 size(frame.size);
    const SolidBounds box = bounds(
        solid, frame_from_solid, SolidBounds{frame.origin, frame.origin + frame.voxel_edge * size});
    double farthest = 0;
    if (!box.is_empty()) {
        const glm::dvec3 centre(first.cell[0] + double(first.fraction[0]),
                                first.cell[1] + double(first.fraction[1]),
                                first.cell[2] + double(first.fraction[2]));
        const glm::dvec3 low = (box.min - frame.origin) / frame.voxel_edge - centre;
        const glm::dvec3 high = (box.max - frame.origin) / frame.voxel_edge - centre;
        farthest = glm::length(glm::max(glm::abs(low), glm::abs(high)));
    }
    if (shapes.size() == 1) {
        glm::dmat3 shape_from_grid;
        for (int i = 0; i < 9; ++i) shape_from_grid[i % 3][i / 3] = first.shape_from_grid[i];
        farthest = std::min(farthest, radius_of(first) / smallest_singular_value(shape_from_grid));
    }
    // Kernels lose some 2^-21 of the way to the centre, which may be 2^24 voxels.
    return float(farthest * (1 + 0x1p-16) + 4);
}

/// Appends shapes in the order of evaluation.
class ProgramWriter {
  public:
    ProgramWriter(const GridFrame& frame, SolidProgram& program)
        : frame_(frame), program_(program) {}

    void write(const Solid& solid, const glm::dmat4& frame_from_parent, bool is_complement) {
        const glm::dmat4 frame_from_solid = frame_from_parent * solid.parent_from_solid;
        if (!is_combination(solid.kind)) {
            program_.shapes.push_back(device_shape(solid, frame_from_solid, frame_, is_complement));
            program_.sources.push_back(
                source_shape(solid, frame_from_solid, frame_, is_complement));
            pending_bits_ = 0;
            return;
        }
        // De Morgan: the complement of a union is the intersection of the complements.
        const bool is_union = (solid.kind == SolidKind::union_of) != is_complement;
        for (size_t i = 0; i < solid.parts.size(); ++i) {
            const bool is_taken_away = solid.kind == SolidKind::difference_of && i > 0;
            write(solid.parts[i], frame_from_solid, is_complement != is_taken_away);
            if (i > 0) combine(is_union ? VXL_SOLID_UNION : VXL_SOLID_INTERSECTION);
        }
    }

  private:
    void combine(uint32_t operation) {
        program_.shapes.back().operations |= operation << pending_bits_;
        program_.sources.back().operations |= operation << pending_bits_;
        pending_bits_ += VXL_SOLID_OPERATION_BITS;
    }

    const GridFrame& frame_;
    SolidProgram& program_;
    int pending_bits_ = 0;  // shift of the next operation in the last shape's operations
};

}  // namespace

std::span<const uint32_t> SolidProgram::words() const {
    return {reinterpret_cast<const uint32_t*>(shapes.data()), shapes.size() * VXL_SOLID_WORDS};
}

SolidProgram make_solid_program(const Solid& solid, const glm::dmat4& frame_from_solid,
                                const GridFrame& frame, bool is_complement) {
    SolidProgram program;
    ProgramWriter(frame, program).write(solid, frame_from_solid, is_complement);
    program.shapes.front().shape_count = static_cast<uint32_t>(program.shapes.size());
    program.shapes.front().reach =
        is_complement ? INFINITY : reach_of(solid, frame_from_solid, frame, program.shapes);
    return program;
}

}  // namespace voxelume
