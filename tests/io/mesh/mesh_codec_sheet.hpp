// SPDX-License-Identifier: Apache-2.0
// A mesh that tests of codecs compress, and checks of the decoded mesh.
#pragma once

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <random>
#include <set>

#include "tests/support/parsed_gltf.hpp"

namespace voxelume {

inline constexpr uint32_t kColumns = 7, kRows = 5;

/// A crooked sheet of 35 vertices and 48 triangles.
struct Sheet {
    Sheet() {
        for (uint32_t y = 0; y < kRows; ++y)
            for (uint32_t x = 0; x < kColumns; ++x) {
                const float u = float(x), v = float(y);
                positions.emplace_back(3 * u, 2 * v + 0.1f * u, std::sin(u) + 0.3f * v * v);
                if (x + 1 == kColumns || y + 1 == kRows) continue;
                const uint32_t a = y * kColumns + x;
                for (const uint32_t i :
                     {a, a + 1, a + kColumns, a + 1, a + kColumns + 1, a + kColumns})
                    indices.push_back(i);
            }
    }
    std::vector<glm::vec3> positions;
    std::vector<uint32_t> indices;
};

/// A position rounded to a lattice so coarse that a codec's steps don't change it.
inline std::array<long, 3> lattice_point(const glm::vec3& p) {
    return {std::lround(p.x / 0.1f), std::lround(p.y / 0.1f), std::lround(p.z / 0.1f)};
}

/// The largest distance between a decoded vertex and the nearest of the sheet.
inline double distance_from(const Sheet& sheet, const Mesh& mesh) {
    double worst = 0;
    for (const glm::vec3& p : mesh.positions) {
        double nearest = INFINITY;
        for (const glm::vec3& q : sheet.positions)
            nearest = std::min<double>(
                nearest, std::max({std::abs(p.x - q.x), std::abs(p.y - q.y), std::abs(p.z - q.z)}));
        worst = std::max(worst, nearest);
    }
    return worst;
}

using Corner = std::array<long, 3>;

/// The triangles by their corners, each cycle beginning with the smallest corner.
template <class Triangles>
std::multiset<std::array<Corner, 3>> triangles_of(const std::vector<glm::vec3>& positions,
                                                  const Triangles& corner_of, size_t count) {
    std::multiset<std::array<Corner, 3>> found;
    for (size_t i = 0; i < count; ++i) {
        std::array<Corner, 3> corners;
        for (size_t c = 0; c < 3; ++c) corners[c] = lattice_point(positions[corner_of(i, c)]);
        std::rotate(corners.begin(), std::min_element(corners.begin(), corners.end()),
                    corners.end());
        found.insert(corners);
    }
    return found;
}

/// Expects the sheet's triangles, at the sheet's vertices nearest to the decoded ones.
inline void expect_same_triangles(const Sheet& sheet, Mesh mesh) {
    for (glm::vec3& p : mesh.positions)
        p = *std::ranges::min_element(sheet.positions, {},
                                      [&](const glm::vec3& q) { return glm::dot(p - q, p - q); });
    const auto of_mesh = [&](size_t i, size_t c) { return mesh.triangles[i][int(c)]; };
    const auto of_sheet = [&](size_t i, size_t c) { return sheet.indices[3 * i + c]; };
    EXPECT_EQ(triangles_of(mesh.positions, of_mesh, mesh.triangles.size()),
              triangles_of(sheet.positions, of_sheet, sheet.indices.size() / 3));
}

/// Reads many copies of the file, each damaged in the bytes from `first` to `end`.
inline void expect_refusals_or_meshes(const GltfWriter& writer, size_t first, size_t end) {
    std::mt19937 random(11);
    int refused = 0;
    for (int i = 0; i < 60; ++i) {
        GltfWriter damaged = writer;
        for (int k = 0; k <= i % 4; ++k)
            damaged.bytes[first + random() % (end - first)] = char(random());
        try {
            const Mesh mesh = gltf_mesh(parsed_gltf(damaged), 0);
            for (const glm::uvec3& t : mesh.triangles)
                ASSERT_LT(std::max({t.x, t.y, t.z}), mesh.positions.size());
        } catch (const Error& error) {
            EXPECT_THAT(error.kind(), testing::AnyOf(ErrorKind::input, ErrorKind::limit));
            EXPECT_THAT(error.what(), testing::StartsWith("a.gltf: ")) << i;
            ++refused;
        }
    }
    EXPECT_GT(refused, 10);
}

}  // namespace voxelume
