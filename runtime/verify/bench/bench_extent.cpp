// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_extent.hpp"

#include <algorithm>
#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <numbers>

#include "kernels/shared/solid.h"
#include "runtime/verify/bench/pyramid_voxels.hpp"

namespace voxelume {
namespace {

constexpr double kPi = std::numbers::pi;

/// The extent of a sphere, torus or box of shape space, in voxels; empty for other shapes.
std::optional<Extent> extent_of(const SolidShape& shape) {
    const double a = shape.size[0], b = shape.size[1], c = shape.size[2];
    switch (shape.kind) {
        case VXL_SOLID_SPHERE:
            return Extent{4 * kPi / 3 * a * a * a, 4 * kPi * a * a};
        case VXL_SOLID_TORUS:
            return Extent{2 * kPi * kPi * a * b * b, 4 * kPi * kPi * a * b};
        case VXL_SOLID_BOX:
            return Extent{8 * a * b * c, 8 * (a * b + b * c + c * a)};
        default:
            return {};
    }
}

}  // namespace

Extent triangles_extent(std::span<const glm::dvec3> corners) {
    Extent extent;
    for (size_t i = 0; i + 2 < corners.size(); i += 3) {
        // Corners are taken relative to the very first one, because parts far from the origin would
        // cancel.
        const glm::dvec3 a = corners[i] - corners[0], b = corners[i + 1] - corners[0],
                         c = corners[i + 2] - corners[0];
        const glm::dvec3 normal = glm::cross(b - a, c - a);
        extent.volume += glm::dot(a, normal) / 6;
        extent.area += glm::length(normal) / 2;
    }
    return extent;
}

std::optional<Extent> exact_extent(const Pyramid& pyramid) {
    if (!pyramid.triangles.empty()) {
        const std::vector<float> words = pyramid.triangles.read();
        std::vector<glm::dvec3> corners;
        for (size_t i = 0; i + 2 < words.size(); i += 3)
            corners.emplace_back(words[i], words[i + 1], words[i + 2]);
        return triangles_extent(corners);
    }
    const std::vector<uint32_t> words = pyramid.solids.read();
    if (words.size() != VXL_SOLID_WORDS) return {};
    SolidShape shape;
    std::memcpy(&shape, words.data(), sizeof shape);
    std::optional<Extent> extent = extent_of(shape);
    if (!extent) return {};
    const float* rows = shape.shape_from_grid;
    const double scale = std::cbrt(std::abs(glm::determinant(glm::dmat3(
        rows[0], rows[1], rows[2], rows[3], rows[4], rows[5], rows[6], rows[7], rows[8]))));
    return Extent{extent->volume / (scale * scale * scale), extent->area / (scale * scale)};
}

std::optional<Extent> extent_of(const Pyramid& pyramid, Surface surface, double scale) {
    constexpr double kMaxCells = 4e8;         // cells of the world's lattice
    constexpr uint32_t kMaxVoxels = 1 << 21;  // voxels with fields
    const GridFrame frame = shown_part(pyramid).frame;
    const double edge = frame.voxel_edge.x * scale;
    std::optional<Extent> extent;
    if (lists_primitives(surface)) {
        extent = exact_extent(pyramid);
    } else if (stores_distances(surface)) {
        if (pyramid.voxel_count <= kMaxVoxels) extent = smooth_extent(pyramid);
    } else {
        const glm::dvec3 size(frame.size);
        if (size.x * size.y * size.z <= kMaxCells) extent = cubes_extent(pyramid);
    }
    if (!extent) return {};
    return Extent{extent->volume * edge * edge * edge, extent->area * edge * edge};
}

}  // namespace voxelume
