// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/surface_extent.hpp"

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/gtc/constants.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>
#include <span>
#include <vector>

#include "runtime/base/huge_pages.hpp"

namespace voxelume {
namespace {

/// A patch's mean shadow per area over all directions, summed over the three axes; an edge's mean
/// extent per length is the same.
constexpr double kMeanShadow = 1.5;

/// The number of bricks that even the smallest surface may lie in.
constexpr double kFewestBricks = 8;

glm::dvec3 area_vector(const Mesh& mesh, const glm::uvec3& t) {
    if (t.y == t.z) return glm::dvec3(0);  // a point or a line, where rounding may say otherwise
    const glm::dvec3 a(mesh.positions[t.x]), b(mesh.positions[t.y]), c(mesh.positions[t.z]);
    return glm::cross(b - a, c - a) / 2.0;
}

/// The part of [low, high] that lies in [from, to], 0 to 1.
double part_of(double low, double high, double from, double to) {
    if (high <= low) return low >= from && low <= to ? 1 : 0;
    return std::max(0.0, std::min(high, to) - std::max(low, from)) / (high - low);
}

SurfaceArea box_area(const SolidBounds& box, const SolidBounds& clip) {
    SurfaceArea area;
    if (box.is_empty()) return area;
    const glm::dvec3 size = box.max - box.min;
    const glm::dvec3 faces{size.y * size.z, size.x * size.z, size.x * size.y};
    for (int axis = 0; axis < 3; ++axis) {
        const int seen = (box.min[axis] > clip.min[axis]) + (box.max[axis] < clip.max[axis]);
        area.shadows[axis] = seen * faces[axis];
    }
    // A surface that is cut on all sides still crosses the box.
    if (area.shadows == glm::dvec3(0)) area.shadows = faces;
    area.total = area.shadows.x + area.shadows.y + area.shadows.z;
    return area;
}

/// The minimum shadows of a shape along its own axes, as parts of its box' shadows.
glm::dvec3 own_shadows(const Solid& solid) {
    constexpr double kDiskShare = glm::pi<double>() / 4;
    switch (solid.kind) {
        case SolidKind::box:
        case SolidKind::slab:
            return glm::dvec3(1);
        case SolidKind::cylinder:
            return {1, kDiskShare, 1};
        case SolidKind::cone:
            return {0.5, kDiskShare, 0.5};
        case SolidKind::torus: {
            const double ring = solid.radius, tube = solid.tube, reach = ring + tube;
            const double side = (ring + kDiskShare * tube) / reach;
            return {side, glm::pi<double>() * ring * tube / (reach * reach), side};
        }
        default:
            return glm::dvec3(kDiskShare);
    }
}

/// The minimum shadows along the axes that `map` turns the shape's axes to; 0 where it doesn't turn
/// them to axes.
glm::dvec3 min_shadows(const Solid& solid, const glm::dmat4& map) {
    const glm::dvec3 own = own_shadows(solid);
    glm::dvec3 shadows(0);
    for (int column = 0; column < 3; ++column) {
        int numbers = 0;
        for (int row = 0; row < 3; ++row) {
            if (map[column][row] == 0) continue;
            ++numbers;
            shadows[row] = own[column];
        }
        if (numbers > 1) return glm::dvec3(0);
    }
    return shadows;
}

uint64_t position_hash(const glm::vec3& position) {
    const glm::vec3 p = position + 0.0f;  // -0 is 0
    uint64_t hash = std::bit_cast<uint32_t>(p.x);
    for (const float value : {p.y, p.z})
        hash = (hash ^ hash >> 29) * 0x9E3779B97F4A7C15u + std::bit_cast<uint32_t>(value);
    hash = (hash ^ hash >> 32) * 0xD6E8FEB86659FD93u;
    return hash ^ hash >> 32;
}

/// A hash of a triangle's corners. It is equal for triangles of equal corners in any order.
uint64_t corner_hash(const std::vector<uint64_t>& hashes, const glm::uvec3& triangle) {
    return (hashes[triangle.x] + hashes[triangle.y] + hashes[triangle.z]) * 0x9E3779B97F4A7C15u;
}

/// The contribution of a triangle to an area.
struct TriangleArea {
    glm::dvec3 shadows;
    double total;
    std::array<glm::dvec3, 3> widths;
    std::array<double, 3> half_edges;
};

TriangleArea area_of(const Mesh& mesh, const glm::uvec3& triangle) {
    TriangleArea area;
    const glm::dvec3 vector = area_vector(mesh, triangle);
    area.shadows = glm::abs(vector);
    area.total = glm::length(vector);
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 edge = glm::dvec3(mesh.positions[triangle[i]]) -
                                glm::dvec3(mesh.positions[triangle[(i + 1) % 3]]);
        area.widths[size_t(i)] =
            glm::abs(edge) / 2.0;  // the three edges cross each axis' range twice
        area.half_edges[size_t(i)] = glm::length(edge) / 2.0;
    }
    return area;
}

void add(const TriangleArea& triangle, SurfaceArea& area) {
    area.shadows += triangle.shadows;
    area.total += triangle.total;
    ++area.triangles;
    for (const glm::dvec3& width : triangle.widths) area.widths += width;
    for (const double half_edge : triangle.half_edges) area.half_edges += half_edge;
}

/// Finds triangles whose corners are those of an earlier one.
class Duplicates {
  public:
    explicit Duplicates(const Mesh& mesh) : mesh_(mesh), hashes_(mesh.positions.size()) {
        // A slot is a bit. At most one triangle in 32 is mistaken for another's duplicate.
        constexpr size_t kSlotsPerTriangle = 16;
        const size_t slots =
            std::bit_ceil(std::max<size_t>(mesh.triangles.size(), 2)) * kSlotsPerTriangle;
        shift_ = 64 - std::countr_zero(slots);
        reserve_in_huge_pages(seen_, (slots + 63) / 64);
        seen_.resize((slots + 63) / 64);
        std::ranges::transform(mesh.positions, hashes_.begin(), position_hash);
    }

    /// Calls `visit` with each triangle and whether it is a duplicate.
    template <class Visit>
    void for_each_triangle(const Visit& visit) {
        // The words of slots lie anywhere in memory, so they are prefetched before their use.
        constexpr size_t kBlock = 64;
        std::array<uint64_t, kBlock> slots{};
        const std::span<const glm::uvec3> all = mesh_.triangles;
        for (size_t first = 0; first < all.size(); first += kBlock) {
            const auto block = all.subspan(first, std::min(kBlock, all.size() - first));
            for (size_t i = 0; i < block.size(); ++i) {
                slots[i] = corner_hash(hashes_, block[i]) >> shift_;
                __builtin_prefetch(&seen_[slots[i] / 64], 1);
            }
            for (size_t i = 0; i < block.size(); ++i) {
                uint64_t& word = seen_[slots[i] / 64];
                const uint64_t bit = uint64_t{1} << slots[i] % 64;
                visit(block[i], (word & bit) != 0);
                word |= bit;
            }
        }
    }

  private:
    const Mesh& mesh_;
    std::vector<uint64_t> hashes_;  ///< one hash for each position
    std::vector<uint64_t> seen_;
    int shift_ = 0;
};

}  // namespace

MeshAreas mesh_areas(const Mesh& mesh) {
    MeshAreas areas;
    bool are_equal = true;  // so far
    Duplicates(mesh).for_each_triangle([&](const glm::uvec3& triangle, bool is_duplicate) {
        const TriangleArea area = area_of(mesh, triangle);
        if (is_duplicate && are_equal) {
            areas.min = areas.all;
            are_equal = false;
        }
        add(area, areas.all);
        if (!are_equal && !is_duplicate) add(area, areas.min);
    });
    if (are_equal) areas.min = areas.all;
    if (areas.all.total == 0) areas.min = {};  // any number of points shares a voxel
    return areas;
}

SurfaceArea solid_area(const Solid& solid, const glm::dmat4& frame_from_solid,
                       const SolidBounds& clip) {
    if (!is_combination(solid.kind)) return box_area(bounds(solid, frame_from_solid, clip), clip);
    SurfaceArea area;
    for (const Solid& part : solid.parts) {
        const SurfaceArea of_part =
            solid_area(part, frame_from_solid * solid.parent_from_solid, clip);
        area.shadows += of_part.shadows;
        area.total += of_part.total;
    }
    return area;
}

SurfaceArea min_solid_area(const Solid& solid, const glm::dmat4& frame_from_solid,
                           const SolidBounds& clip) {
    const glm::dmat4 map = frame_from_solid * solid.parent_from_solid;
    SurfaceArea maximum;
    if (!is_combination(solid.kind)) {
        maximum = solid_area(solid, frame_from_solid, clip);
        maximum.shadows *= min_shadows(solid, map);
        maximum.total = maximum.shadows.x + maximum.shadows.y + maximum.shadows.z;
        return maximum;
    }
    // An intersection or difference may leave nothing.
    if (solid.kind != SolidKind::union_of) return maximum;
    for (const Solid& part : solid.parts) {
        const SurfaceArea of_part = min_solid_area(part, map, clip);
        if (of_part.total >= maximum.total) maximum = of_part;
    }
    return maximum;
}

double part_inside(const Mesh& mesh, const glm::dmat4& box_from_mesh, const SolidBounds& box) {
    double inside = 0, total = 0;
    for (const glm::uvec3& triangle : mesh.triangles) {
        glm::dvec3 low(INFINITY), high(-INFINITY);
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 p(box_from_mesh *
                               glm::dvec4(glm::dvec3(mesh.positions[triangle[corner]]), 1.0));
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const double area = glm::length(area_vector(mesh, triangle));
        double part = 1;
        for (int axis = 0; axis < 3; ++axis)
            part *= part_of(low[axis], high[axis], box.min[axis], box.max[axis]);
        inside += part * area;
        total += area;
    }
    return total > 0 ? inside / total : 1;
}

SurfaceExtent surface_extent(const SurfaceArea& area, const glm::dmat4& frame_from_surface,
                             const GridFrame& frame, double band) {
    glm::dmat3 voxels_from_surface(frame_from_surface);
    for (int column = 0; column < 3; ++column) voxels_from_surface[column] /= frame.voxel_edge;
    // Area vectors map by the matrix of cofactors.
    const glm::dmat3 cofactors = std::abs(glm::determinant(voxels_from_surface)) *
                                 glm::transpose(glm::inverse(voxels_from_surface));
    glm::dvec3 shadows(0), widths(0);
    double largest = 0, longest = 0;
    for (int column = 0; column < 3; ++column) {
        shadows += glm::abs(cofactors[column]) * area.shadows[column];
        largest = std::max(largest, glm::length(cofactors[column]));
        widths += glm::abs(voxels_from_surface[column]) * area.widths[column];
        longest = std::max(longest, glm::length(voxels_from_surface[column]));
    }
    const double mean = kMeanShadow * area.total * largest;
    SurfaceExtent extent;
    extent.voxels = std::min(shadows.x + shadows.y + shadows.z, mean);
    extent.listed =
        extent.voxels + area.triangles +
        std::min(widths.x + widths.y + widths.z, kMeanShadow * area.half_edges * longest);
    const double thickness = kBrickSize + 2 * band / kMeanShadow;
    const glm::dvec3 table(frame.bricks()), size(frame.size);
    double bricks = extent.voxels * thickness / (kBrickSize * kBrickSize * kBrickSize);
    // Each point has a voxel and a brick of its own, and each line has those that it passes.
    if (area.total == 0) bricks = extent.voxels = std::min(extent.listed, size.x * size.y * size.z);
    extent.bricks = std::min(bricks + kFewestBricks, table.x * table.y * table.z);
    return extent;
}

}  // namespace voxelume
