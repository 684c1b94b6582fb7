// SPDX-License-Identifier: Apache-2.0
// Worlds of few solids: rays that test all solids at once meet what walking rays meet, to the bit.
#include <gtest/gtest.h>

#include <algorithm>
#include <bit>
#include <cmath>
#include <numeric>
#include <random>

#include "kernels/shared/solid.h"
#include "runtime/grid/grid_arguments.hpp"
#include "runtime/stages/index/index.hpp"
#include "runtime/stages/place/place.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"
#include "runtime/verify/stress/device_walks.hpp"
#include "runtime/verify/stress/ray_classes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kSeed = 20261129;
constexpr uint32_t kRaysOfClass = 4096;

/// Solids of all kinds and combinations, stretched, turned and moved.
std::vector<Solid> random_solids(std::mt19937& random, int count) {
    const auto uniform = [&](double low, double high) {
        return low + (high - low) * double(random()) / 4294967296.0;
    };
    std::vector<SolidCase> cases = shape_cases();
    for (const SolidCase& c : combination_cases()) cases.push_back(c);
    std::vector<Solid> solids;
    for (int i = 0; i < count; ++i) {
        Solid solid = cases[random() % cases.size()].solid;
        const glm::dmat4 turn = rational_rotation(int(random() % 5) + 1, int(random() % 5) - 2,
                                                  int(random() % 5) - 2, int(random() % 5) - 2);
        const glm::dvec3 by(uniform(0.2, 1.1), uniform(0.2, 1.1), uniform(0.2, 1.1));
        const glm::dmat4 map =
            random() % 2 ? stretched(turn, by) : stretched(turn, glm::dvec3(by.x));
        solid.parent_from_solid = moved(map * solid.parent_from_solid,
                                        {uniform(-24, 24), uniform(-22, 22), uniform(-20, 20)});
        solids.push_back(solid);
    }
    return solids;
}

/// A world of these solids; with `order`, their surfaces may coincide.
Pyramid world_of(const Device& device, const std::vector<Solid>& solids, bool has_order) {
    GridFrame frame;
    frame.voxel_edge = {0.8, 0.7, 0.9};
    frame.size = {71, 66, 49};
    frame.origin = glm::dvec3(frame.size) * frame.voxel_edge * -0.5;
    std::vector<BrickGrid> grids;
    std::vector<PlacedObject> objects;
    for (const Solid& solid : solids)
        grids.push_back(
            voxelize_solid(device, solid, glm::dmat4(1), frame, {.surface = Surface::exact}));
    for (const BrickGrid& grid : grids)
        objects.push_back({.grid = &grid,
                           .object = uint32_t(objects.size()),
                           .material_of_group = {uint32_t(objects.size())},
                           .in_world_frame = true});
    Pyramid pyramid = build_index(device, place(device, objects, frame));
    std::vector<uint32_t> order(solids.size());
    std::iota(order.rbegin(), order.rend(), 0u);
    if (has_order) pyramid.order = Buffer<uint32_t>(device, "order", order);
    return pyramid;
}

/// Rays of each difficult class.
std::vector<FixedRay> rays_through(const FixedGrid& grid, uint32_t of_class) {
    std::vector<FixedRay> rays;
    for (const RayClassName& c : kRayClasses)
        for (uint32_t i = 0; i < of_class; ++i)
            rays.push_back(ray_of_class(c.kind, grid, kSeed, i));
    return rays;
}

/// The words of the hits; of misses, their mark alone.
std::vector<uint32_t> hits_of(const Device& device, const Pyramid& pyramid,
                              const Features& features, const std::vector<FixedRay>& rays) {
    RayBatch batch;
    batch.stride = (uint32_t(rays.size()) + 255) / 256 * 256;
    const std::vector<float> values =
        ray_components(fixed_grid(pyramid.frame.size), rays, batch.stride);
    batch.rays = Buffer<float>(device, "rays", std::span<const float>(values));
    batch.hits = Buffer<uint32_t>(device, "hits", size_t(batch.stride) * VXL_HIT_COMPONENTS);
    TraceStage(device, features).closest(pyramid, batch, uint32_t(rays.size()));
    std::vector<uint32_t> words = batch.hits.read(0, size_t(batch.stride) * VXL_HIT_INSTANCE);
    for (size_t i = 0; i < batch.stride; ++i)
        if (words[VXL_HIT_VOXEL * batch.stride + i] == VXL_NO_VOXEL)
            for (size_t c = 0; c < VXL_HIT_INSTANCE; ++c)
                words[c * batch.stride + i] = VXL_NO_VOXEL;
    return words;
}

/// True if the ray's point at t lies on a side of the world, as far as rounding tells.
bool is_on_side(const Pyramid& pyramid, const FixedRay& ray, float t) {
    const double unit = double(fixed_grid(pyramid.frame.size).unit());
    const double bound = 2 * double(shape_of(pyramid).plane_bound);
    for (size_t a = 0; a < 3; ++a) {
        const double x = double(ray.origin[a]) / unit +
                         double(t) * double(ray.direction[a]) / double(kDirectionOne);
        const double side = pyramid.frame.size[int(a)];
        if (std::min(std::abs(x), std::abs(side - x)) <= bound) return true;
    }
    return false;
}

/// The hits of rays that test all solids at once, and of walking rays.
struct BothHits {
    std::vector<uint32_t> ahead, walked;

    size_t stride() const { return ahead.size() / VXL_HIT_INSTANCE; }
    bool differ(size_t ray) const {
        for (size_t c = 0; c < VXL_HIT_INSTANCE; ++c)
            if (ahead[c * stride() + ray] != walked[c * stride() + ray]) return true;
        return false;
    }
    bool is_hit(size_t ray) const { return ahead[VXL_HIT_VOXEL * stride() + ray] != VXL_NO_VOXEL; }
    /// The t of the hit that one of the two has.
    float t(size_t ray) const {
        return std::bit_cast<float>((is_hit(ray) ? ahead : walked)[VXL_HIT_T * stride() + ray]);
    }
};

BothHits both_hits(const Device& device, const Pyramid& pyramid,
                   const std::vector<FixedRay>& rays) {
    Features features = features_of(pyramid);
    EXPECT_TRUE(features.solids_ahead);
    EXPECT_FALSE(features.cubes);
    BothHits both{hits_of(device, pyramid, features, rays), {}};
    features.solids_ahead = false;
    both.walked = hits_of(device, pyramid, features, rays);
    features.cubes = features.attributes;
    EXPECT_EQ(both.walked, hits_of(device, pyramid, features, rays));
    return both;
}

/// Compares both ways of rays through worlds of up to seven solids. Rays that leave the world
/// within rounding of a hit on its side may differ, and hardly one in 10,000 of these difficult
/// rays does.
void expect_same_hits(const Device& device, int worlds, uint32_t of_class) {
    std::mt19937 random(kSeed);
    size_t hits = 0, differing = 0;
    for (int i = 0; i < worlds; ++i) {
        const std::vector<Solid> solids = random_solids(random, 1 + int(random() % 7));
        const Pyramid pyramid = world_of(device, solids, i % 2 == 1);
        const std::vector<FixedRay> rays = rays_through(fixed_grid(pyramid.frame.size), of_class);
        const BothHits both = both_hits(device, pyramid, rays);
        for (size_t ray = 0; ray < rays.size(); ++ray) {
            hits += both.is_hit(ray);
            if (!both.differ(ray)) continue;
            ++differing;
            ASSERT_TRUE(is_on_side(pyramid, rays[ray], both.t(ray)))
                << "seed " << kSeed << " world " << i << " class " << ray / of_class << " ray "
                << ray % of_class;
        }
    }
    EXPECT_GT(hits, size_t(worlds) * of_class);
    EXPECT_LT(differing, size_t(worlds) * of_class / 1000);
}

TEST(AllSolids, AreMetAtOnceWhereWalksMeetThem) {
    for (const int lanes : lanes_to_compare(1))
        expect_same_hits(test_device(lanes), lanes == 1 ? 4 : 24, kRaysOfClass);
}

TEST(AllSolids, AreMetAlikeByManyRays) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    expect_same_hits(test_device(16), 200, 65536);
}

TEST(AllSolids, OnTheWorldsSideAreMetByRaysThatGrazeThem) {
    const Device device = test_device();
    Solid ground;  // its top is the lower side of the world, and it is as deep as the world is long
    ground.kind = SolidKind::box;
    ground.size = {300, 50, 300};
    ground.parent_from_solid = moved(glm::dmat4(1), {0, -66 * 0.7 / 2 - 25, 0});
    Solid ball;
    ball.radius = 3;
    const Pyramid pyramid = world_of(device, {ground, ball}, true);
    const FixedGrid grid = fixed_grid(pyramid.frame.size);
    std::vector<FixedRay> rays;
    for (int64_t i = 0; i < 4096; ++i) {  // down by 0.2 to 1.1 degrees
        const double height = 0.01 + 0.05 * double(i % 64) / 64;
        rays.push_back({{grid.unit() / 2 + i, int64_t(height * double(grid.unit())), i * 7},
                        {kDirectionOne, -(kDirectionOne / 300 + i * 16), i % 5}});
    }
    const BothHits both = both_hits(device, pyramid, rays);
    for (size_t ray = 0; ray < rays.size(); ++ray) {
        EXPECT_TRUE(both.is_hit(ray)) << ray;
        EXPECT_FALSE(both.differ(ray)) << ray;
    }
}

TEST(AllSolids, AreTestedAtOnceOnlyWhereThereIsNothingElse) {
    const Device device = test_device();
    std::mt19937 random(kSeed);
    const std::vector<Solid> solids = random_solids(random, 3);
    Pyramid pyramid = world_of(device, solids, false);
    EXPECT_TRUE(features_of(pyramid).solids_ahead);
    pyramid.cubes = true;
    EXPECT_FALSE(features_of(pyramid).solids_ahead);
    pyramid.cubes = false;
    pyramid.triangles = Buffer<float>(device, "triangles", 9);
    EXPECT_FALSE(features_of(pyramid).solids_ahead);
    pyramid.triangles = {};
    pyramid.solids = Buffer<uint32_t>(device, "solids", size_t{129} * VXL_SOLID_WORDS);
    EXPECT_FALSE(features_of(pyramid).solids_ahead);
}

}  // namespace
}  // namespace voxelume
