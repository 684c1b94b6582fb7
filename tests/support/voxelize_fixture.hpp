// SPDX-License-Identifier: Apache-2.0
// Meshes in voxels and grids read back, for the tests of voxelization.
#pragma once

#include <gtest/gtest.h>

#include <cmath>
#include <map>
#include <random>
#include <set>
#include <vector>

#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/oracles/mesh/triangle_overlap.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

/// Voxels in order of z, y, x.
struct VoxelLess {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
        return std::tie(a.z, a.y, a.x) < std::tie(b.z, b.y, b.x);
    }
};
using VoxelSetOf = std::set<glm::ivec3, VoxelLess>;

/// One voxelizer for all tests, so that each kernel is built once. It is never freed, because its
/// platform may be gone before static objects are.
inline Voxelizer& shared_voxelizer() {
    static Voxelizer* const voxelizer = new Voxelizer(test_device());
    return *voxelizer;
}

/// A frame whose voxels are the units of the mesh.
inline GridFrame unit_frame(const glm::ivec3& size) {
    GridFrame frame;
    frame.size = size;
    return frame;
}

inline void add_triangle(Mesh& mesh, const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    const auto first = static_cast<uint32_t>(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), {a, b, c});
    mesh.triangles.emplace_back(first, first + 1, first + 2);
}

inline Mesh single_triangle(const glm::vec3& a, const glm::vec3& b, const glm::vec3& c) {
    Mesh mesh;
    add_triangle(mesh, a, b, c);
    return mesh;
}

/// The box [low, high], 12 triangles, outward.
inline Mesh box_mesh(const glm::vec3& low, const glm::vec3& high) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                    i & 4 ? high.z : low.z);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// A torus around the z axis through `center`, closed, outward.
inline Mesh torus_mesh(const glm::vec3& center, float major, float minor, int around, int across) {
    Mesh mesh;
    const auto angle = [](int i, int n) { return 2 * M_PI * i / n; };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            const double u = angle(i, around), v = angle(j, across);
            const double r = major + minor * std::cos(v);
            mesh.positions.push_back(
                center + glm::vec3(r * std::cos(u), r * std::sin(u), minor * std::sin(v)));
        }
    const auto at = [&](int i, int j) {
        return static_cast<uint32_t>((i % around) * across + j % across);
    };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

/// A ball of longitudes and latitudes, with only the latitude bands first .. last of `rows`.
inline Mesh ball_mesh(const glm::vec3& center, float radius, int columns, int rows, int first = 0,
                      int last = 1 << 20) {
    Mesh mesh;
    const auto point = [&](int row, int column) {
        const double v = M_PI * row / rows, u = 2 * M_PI * (column % columns) / columns;
        return center + glm::vec3(radius * std::sin(v) * std::cos(u),
                                  radius * std::sin(v) * std::sin(u), -radius * std::cos(v));
    };
    for (int row = first; row < std::min(rows, last); ++row)
        for (int column = 0; column < columns; ++column) {
            const glm::vec3 a = point(row, column), b = point(row, column + 1),
                            c = point(row + 1, column + 1), d = point(row + 1, column);
            if (row > 0) add_triangle(mesh, a, b, c);
            if (row + 1 < rows) add_triangle(mesh, a, c, d);
        }
    return mesh;
}

inline oracle::LatticeCorners lattice_corners(const Mesh& mesh, size_t triangle) {
    oracle::LatticeCorners corners;
    for (int i = 0; i < 3; ++i)
        corners[i] = glm::ivec3(
            glm::roundEven(glm::dvec3(mesh.positions[mesh.triangles[triangle][i]]) * 4096.0));
    return corners;
}

inline std::vector<oracle::LatticeCorners> lattice_mesh(const Mesh& mesh) {
    std::vector<oracle::LatticeCorners> all;
    for (size_t i = 0; i < mesh.triangles.size(); ++i) all.push_back(lattice_corners(mesh, i));
    return all;
}

/// The position of a voxel or node in the arrays of a brick grid that was read back.
struct GridSlot {
    uint32_t slot;    ///< or kBrickOutside, kBrickInside
    uint32_t number;  ///< within the brick, x fastest
};

inline GridSlot slot_in(const BrickGrid& grid, const std::vector<uint32_t>& slots,
                        const glm::ivec3& v) {
    const glm::ivec3 bricks = grid.frame.bricks(), b = v / 16, l = v % 16;
    return {slots.at(size_t((b.z * bricks.y + b.y) * bricks.x + b.x)),
            uint32_t(l.z * 256 + l.y * 16 + l.x)};
}

/// The set voxels, including those of bricks marked inside.
inline VoxelSetOf occupied_voxels(const BrickGrid& grid) {
    const std::vector<uint32_t> slots = grid.slots.read();
    const std::vector<uint64_t> masks = grid.occupancy.read();
    const glm::ivec3 bricks = grid.frame.bricks();
    VoxelSetOf voxels;
    for (int z = 0; z < bricks.z * 16; ++z)
        for (int y = 0; y < bricks.y * 16; ++y)
            for (int x = 0; x < bricks.x * 16; ++x) {
                const glm::ivec3 v(x, y, z);
                const uint32_t slot = slot_in(grid, slots, v).slot;
                if (slot == kBrickInside) voxels.insert(v);
                if (slot >= kBrickInside) continue;
                const int leaf = x / 4 % 4 | (y / 4 % 4) << 2 | (z / 4 % 4) << 4;
                const int bit = x % 4 | (y % 4) << 2 | (z % 4) << 4;
                if (masks.at(64 * slot + size_t(leaf)) >> bit & 1) voxels.insert(v);
            }
    return voxels;
}

inline VoxelizeOptions cubes(VoxelSet set) {
    VoxelizeOptions options;
    options.surface = Surface::cubes;
    options.set = set;
    return options;
}

inline VoxelSetOf voxels_of(const Mesh& mesh, const glm::ivec3& size, VoxelSet set,
                            Voxelizer& voxelizer = shared_voxelizer()) {
    return occupied_voxels(voxelizer.voxelize(mesh, glm::dmat4(1), unit_frame(size), cubes(set)));
}

/// The voxels of the frame for which `is_set` returns true.
template <class Predicate>
VoxelSetOf voxels_where(const glm::ivec3& size, Predicate is_set) {
    VoxelSetOf voxels;
    for (int z = 0; z < size.z; ++z)
        for (int y = 0; y < size.y; ++y)
            for (int x = 0; x < size.x; ++x)
                if (is_set(glm::ivec3(x, y, z))) voxels.insert({x, y, z});
    return voxels;
}

inline VoxelSetOf exact_supercover(const Mesh& mesh, const glm::ivec3& size, int margin = 0) {
    const auto triangles = lattice_mesh(mesh);
    return voxels_where(size, [&](const glm::ivec3& v) {
        return std::any_of(triangles.begin(), triangles.end(), [&](const auto& t) {
            return oracle::cube_meets_triangle(v, t, margin);
        });
    });
}

inline VoxelSetOf exact_thin(const Mesh& mesh, const glm::ivec3& size) {
    const auto triangles = lattice_mesh(mesh);
    return voxels_where(size, [&](const glm::ivec3& v) {
        return std::any_of(triangles.begin(), triangles.end(),
                           [&](const auto& t) { return oracle::crosshair_meets_triangle(v, t); });
    });
}

inline VoxelSetOf exact_solid(const Mesh& mesh, const glm::ivec3& size) {
    const auto triangles = lattice_mesh(mesh);
    return voxels_where(size, [&](const glm::ivec3& v) {
        return oracle::winding_number(v * 4096 + 2048, triangles) > 0;
    });
}

/// Returns an empty text if both are equal; otherwise how many voxels differ, and the first of
/// them.
inline std::string difference(const VoxelSetOf& actual, const VoxelSetOf& expected) {
    size_t missing = 0, extra = 0;
    std::string first;
    const auto note = [&](const char* what, const glm::ivec3& v) {
        if (first.empty()) first = fmt::format("; first {} ({},{},{})", what, v.x, v.y, v.z);
    };
    for (const glm::ivec3& v : expected)
        if (!actual.count(v)) ++missing, note("missing", v);
    for (const glm::ivec3& v : actual)
        if (!expected.count(v)) ++extra, note("extra", v);
    if (missing + extra == 0) return "";
    return fmt::format("{} missing, {} extra of {}{}", missing, extra, expected.size(), first);
}

}  // namespace voxelume
