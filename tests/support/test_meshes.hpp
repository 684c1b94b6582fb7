// SPDX-License-Identifier: Apache-2.0
// Closed meshes that tests render, and the OBJ files that scenes name.
#pragma once

#include <fmt/format.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <glm/glm.hpp>
#include <numbers>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// Joins a grid of points, closed both ways, to triangles that face outwards.
inline Mesh closed_grid(int around, int across, const auto& point) {
    Mesh mesh;
    const auto angle = [](int i, int n) { return 2 * std::numbers::pi * i / n; };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j)
            mesh.positions.emplace_back(point(angle(i, around), angle(j, across)));
    const auto at = [&](int i, int j) { return uint32_t(i % around * across + j % across); };
    for (int i = 0; i < around; ++i)
        for (int j = 0; j < across; ++j) {
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i + 1, j + 1));
            mesh.triangles.emplace_back(at(i, j), at(i + 1, j + 1), at(i, j + 1));
        }
    return mesh;
}

/// A ring without symmetry, about 1 long, 0.8 high and 0.4 deep: its tube swells and waves.
inline Mesh wavy_ring(int around, int across) {
    return closed_grid(around, across, [](double u, double v) {
        const double tube = 0.17 + 0.03 * std::sin(2 * u + 0.5);
        const double radius = 0.31 + tube * std::cos(v);
        return glm::dvec3(radius * std::cos(u), 0.83 * radius * std::sin(u),
                          tube * std::sin(v) + 0.05 * std::cos(3 * u));
    });
}

/// The mesh with every triangle doubled: the copy has its own corners, or the same corners in the
/// opposite order.
inline Mesh doubled(Mesh mesh, bool has_own_corners) {
    const auto positions = mesh.positions;
    const auto triangles = mesh.triangles;
    const auto first = uint32_t(has_own_corners ? positions.size() : 0);
    if (has_own_corners)
        mesh.positions.insert(mesh.positions.end(), positions.begin(), positions.end());
    for (const glm::uvec3& t : triangles)
        mesh.triangles.emplace_back(t.y + first, t.x + first, t.z + first);
    return mesh;
}

/// A ball of `columns` x `rows` quadrilaterals, its poles along Y.
inline Mesh ball(const glm::dvec3& center, double radius, int columns, int rows) {
    Mesh mesh;
    const auto point = [&](int row, int column) {
        const double v = std::numbers::pi * row / rows, u = 2 * std::numbers::pi * column / columns;
        return glm::vec3(center + radius * glm::dvec3(std::sin(v) * std::cos(u), std::cos(v),
                                                      -std::sin(v) * std::sin(u)));
    };
    mesh.positions.push_back(point(0, 0));
    for (int row = 1; row < rows; ++row)
        for (int column = 0; column < columns; ++column)
            mesh.positions.push_back(point(row, column));
    mesh.positions.push_back(point(rows, 0));
    const auto last = uint32_t(mesh.positions.size() - 1);
    const auto at = [&](int row, int column) {
        return uint32_t(1 + (row - 1) * columns + column % columns);
    };
    for (int column = 0; column < columns; ++column) {
        mesh.triangles.emplace_back(0, at(1, column), at(1, column + 1));
        for (int row = 1; row + 1 < rows; ++row) {
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column),
                                        at(row + 1, column + 1));
            mesh.triangles.emplace_back(at(row, column), at(row + 1, column + 1),
                                        at(row, column + 1));
        }
        mesh.triangles.emplace_back(last, at(rows - 1, column + 1), at(rows - 1, column));
    }
    return mesh;
}

/// The box [low, high], 12 triangles that face outwards.
inline Mesh box(const glm::vec3& low, const glm::vec3& high) {
    Mesh mesh;
    for (int i = 0; i < 8; ++i)
        mesh.positions.emplace_back(i & 1 ? high.x : low.x, i & 2 ? high.y : low.y,
                                    i & 4 ? high.z : low.z);
    mesh.triangles = {{0, 2, 1}, {1, 2, 3}, {4, 5, 6}, {5, 7, 6}, {0, 1, 4}, {1, 5, 4},
                      {2, 6, 3}, {3, 6, 7}, {0, 4, 2}, {2, 4, 6}, {1, 3, 5}, {3, 7, 5}};
    return mesh;
}

/// Writes an OBJ file that gives exactly the same coordinates and normals when it is read.
inline void write_obj(const std::filesystem::path& path, const Mesh& mesh) {
    std::ofstream file(path);
    for (const glm::vec3& p : mesh.positions)
        file << fmt::format("v {:.9g} {:.9g} {:.9g}\n", p.x, p.y, p.z);
    for (const glm::vec3& n : mesh.normals)
        file << fmt::format("vn {:.9g} {:.9g} {:.9g}\n", n.x, n.y, n.z);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3 t = mesh.triangles[i] + 1u;
        const glm::uvec3 n = mesh.triangle_normals.empty() ? t : mesh.triangle_normals[i] + 1u;
        if (mesh.normals.empty())
            file << fmt::format("f {} {} {}\n", t.x, t.y, t.z);
        else
            file << fmt::format("f {}//{} {}//{} {}//{}\n", t.x, n.x, t.y, n.y, t.z, n.z);
    }
}

}  // namespace voxelume
