// SPDX-License-Identifier: Apache-2.0
// The connected parts of smooth surfaces in the world's voxels, against those of the solids'
// formulas: nothing floats, nothing is torn, and what lies inside other parts is gone.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <string>
#include <vector>

#include "runtime/scene/parts/scene_affine.hpp"
#include "runtime/scene/parts/solid.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/placed_world.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "tests/place/placing.hpp"
#include "tests/place/pyramid_reader.hpp"

namespace voxelume {
namespace {

const glm::ivec3 kCells(46, 40, 43);

GridFrame world_of_cells() {
    return frame_at({-2.3, -2, -2.15}, glm::dvec3(0.1), kCells);
}

/// Cells of the world, as a set.
class Cells {
  public:
    void add(const glm::ivec3& cell) { set_[index(cell)] = true; }
    bool has(const glm::ivec3& cell) const {
        return glm::all(glm::greaterThanEqual(cell, glm::ivec3(0))) &&
               glm::all(glm::lessThan(cell, kCells)) && set_[index(cell)];
    }
    template <class Visit>
    static void for_each(const Visit& visit) {
        for (glm::ivec3 v{0}; v.z < kCells.z; ++v.z)
            for (v.y = 0; v.y < kCells.y; ++v.y)
                for (v.x = 0; v.x < kCells.x; ++v.x) visit(v);
    }
    template <class Visit>
    static void for_neighbours(const glm::ivec3& cell, const Visit& visit) {
        for (int i = 0; i < 27; ++i) visit(cell + glm::ivec3(i % 3, i / 3 % 3, i / 9) - 1);
    }

    /// The number of parts that touch nowhere, not even at corners.
    int components() const {
        Cells seen;
        int count = 0;
        for_each([&](const glm::ivec3& first) {
            if (!has(first) || seen.has(first)) return;
            ++count;
            std::vector<glm::ivec3> open{first};
            seen.add(first);
            while (!open.empty()) {
                const glm::ivec3 cell = open.back();
                open.pop_back();
                for_neighbours(cell, [&](const glm::ivec3& next) {
                    if (!has(next) || seen.has(next)) return;
                    seen.add(next);
                    open.push_back(next);
                });
            }
        });
        return count;
    }

  private:
    static size_t index(const glm::ivec3& v) {
        return size_t(v.x) + size_t(kCells.x) * (size_t(v.y) + size_t(kCells.y) * size_t(v.z));
    }
    std::vector<bool> set_ =
        std::vector<bool>(size_t(kCells.x) * size_t(kCells.y) * size_t(kCells.z));
};

using ComponentShape = double (*)(const glm::dvec3&);

/// The cells through which a function changes its sign, as 5 x 5 x 5 points of each tell.
Cells cells_of(ComponentShape shape) {
    constexpr int kPoints = 5;
    const GridFrame frame = world_of_cells();
    Cells cells;
    Cells::for_each([&](const glm::ivec3& cell) {
        int inside = 0;
        for (int i = 0; i < kPoints * kPoints * kPoints; ++i) {
            const glm::dvec3 at =
                glm::dvec3(i % kPoints, i / kPoints % kPoints, i / (kPoints * kPoints)) /
                (kPoints - 1.0);
            inside += shape(frame.origin + frame.voxel_edge * (glm::dvec3(cell) + at)) < 0 ? 1 : 0;
        }
        if (inside != 0 && inside != kPoints * kPoints * kPoints) cells.add(cell);
    });
    return cells;
}

Cells cells_of(const Pyramid& pyramid) {
    const HostPyramid host(pyramid);
    Cells cells;
    Cells::for_each([&](const glm::ivec3& cell) {
        int log2 = 0;
        if (host.find(cell, log2)) cells.add(cell);
    });
    return cells;
}

Solid ball(const glm::dvec3& centre, double radius) {
    Solid solid;
    solid.kind = SolidKind::sphere;
    solid.radius = radius;
    solid.parent_from_solid[3] = glm::dvec4(centre, 1);
    return solid;
}

Solid ring() {
    Solid solid;
    solid.kind = SolidKind::torus;
    solid.radius = 1.3, solid.tube = 0.4;
    return solid;
}

Solid joined(SolidKind kind, std::vector<Solid> parts) {
    Solid solid;
    solid.kind = kind;
    solid.parts = std::move(parts);
    return solid;
}

double to_ball(const glm::dvec3& p, const glm::dvec3& centre, double radius) {
    return glm::length(p - centre) - radius;
}

double to_ring(const glm::dvec3& p) {
    return std::hypot(std::hypot(p.x, p.z) - 1.3, p.y) - 0.4;
}

/// Solids of several objects, and the function of all.
struct ComponentCase {
    const char* name;
    std::vector<Solid> objects;
    ComponentShape shape;
    int components;
};

std::vector<ComponentCase> component_cases() {
    const glm::dvec3 o(0);
    return {
        {"two balls apart",
         {ball({-1.2, 0, 0}, 0.9), ball({1.1, 0.1, 0}, 0.8)},
         [](const glm::dvec3& p) {
             return std::min(to_ball(p, {-1.2, 0, 0}, 0.9), to_ball(p, {1.1, 0.1, 0}, 0.8));
         },
         2},
        {"a union of two balls apart",
         {joined(SolidKind::union_of, {ball({-1.2, 0, 0}, 0.9), ball({1.1, 0.1, 0}, 0.8)})},
         [](const glm::dvec3& p) {
             return std::min(to_ball(p, {-1.2, 0, 0}, 0.9), to_ball(p, {1.1, 0.1, 0}, 0.8));
         },
         2},
        {"a ring through a ball",
         {joined(SolidKind::union_of, {ring(), ball({1.2, 0, 0}, 0.8)})},
         [](const glm::dvec3& p) {
             return std::min(to_ring(p), to_ball(p, {1.2, 0, 0}, 0.8));
         },
         1},
        {"a ball in a ball",
         {joined(SolidKind::union_of, {ball(o, 0.9), ball(o, 1.7)})},
         [](const glm::dvec3& p) { return to_ball(p, glm::dvec3(0), 1.7); },
         1},
        {"a hollow ball",
         {joined(SolidKind::difference_of, {ball(o, 1.7), ball(o, 1.1)})},
         [](const glm::dvec3& p) {
             return std::max(to_ball(p, glm::dvec3(0), 1.7), -to_ball(p, glm::dvec3(0), 1.1));
         },
         2},
        {"a ball cut in three",
         {joined(SolidKind::difference_of,
                 {ring(), ball({1.3, 0, 0}, 0.6), ball({-0.7, 0, 1.1}, 0.6),
                  ball({-0.7, 0, -1.1}, 0.6)})},
         [](const glm::dvec3& p) {
             return std::max({to_ring(p), -to_ball(p, {1.3, 0, 0}, 0.6),
                              -to_ball(p, {-0.7, 0, 1.1}, 0.6), -to_ball(p, {-0.7, 0, -1.1}, 0.6)});
         },
         3},
        {"what balls share",
         {joined(SolidKind::intersection_of, {ball({-1, 0, 0}, 1.3), ball({0.9, 0, 0}, 1.2)})},
         [](const glm::dvec3& p) {
             return std::max(to_ball(p, {-1, 0, 0}, 1.3), to_ball(p, {0.9, 0, 0}, 1.2));
         },
         1}};
}

Pyramid pyramid_of_solids(const std::vector<Solid>& solids) {
    const Device& device = shared_device();
    const GridFrame frame = world_of_cells();
    std::vector<BrickGrid> grids;
    std::vector<PlacedObject> objects;
    for (const Solid& solid : solids)
        grids.push_back(voxelize_parts(device, solid, glm::dmat4(1), frame));
    for (const BrickGrid& grid : grids)
        objects.push_back({.grid = &grid, .object = uint32_t(objects.size())});
    return Indexer(device).index(place_world(device, objects, frame), nullptr);
}

TEST(Components, OfSmoothSurfacesAreThoseOfTheirSolids) {
    for (const ComponentCase& c : component_cases()) {
        const Cells expected = cells_of(c.shape), found = cells_of(pyramid_of_solids(c.objects));
        EXPECT_EQ(expected.components(), c.components) << c.name;
        EXPECT_EQ(found.components(), c.components) << c.name;
        size_t missing = 0, floating = 0;
        Cells::for_each([&](const glm::ivec3& cell) {
            missing += expected.has(cell) && !found.has(cell);
            // A voxel next to an edge between two parts may hold surfaces of both.
            const glm::dvec3 middle =
                world_of_cells().origin + world_of_cells().voxel_edge * (glm::dvec3(cell) + 0.5);
            floating += found.has(cell) && std::abs(c.shape(middle)) > 0.1 * std::sqrt(3.0);
        });
        EXPECT_EQ(missing, 0u) << c.name;
        EXPECT_EQ(floating, 0u) << c.name;
    }
}

}  // namespace
}  // namespace voxelume
