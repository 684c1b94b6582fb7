// SPDX-License-Identifier: Apache-2.0
// The light that the medium absorbs and adds, against sums over the cells that an exact walk
// passes.
#include "runtime/stages/medium/medium.hpp"

#include <gmock/gmock.h>

#include "tests/light/medium_fixture.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/interpreted.hpp"

namespace voxelume {
namespace {

const glm::ivec3 kSize{70, 50, 30};

double height_density(double base, double scale_height, double y) {
    return y <= base ? 1 : double(float(std::exp((base - y) / scale_height)));
}

double ball_density(const BallDensity& ball, const glm::dvec3& p) {
    const double distance = glm::length(p - ball.center);
    if (distance <= ball.radius - ball.falloff) return 1;
    if (distance >= ball.radius) return 0;
    const double s = (ball.radius - distance) / ball.falloff;
    return double(float(s * s * (3 - 2 * s)));
}

/// Compares every ray's transmittance with exp(-absorption * depth): within 1e-6 of it for optical
/// depths up to 4, then within 2.5e-7 of the optical depth.
void expect_beers_law(const World& world, const DensityAt& density, unsigned seed) {
    const std::vector<MediumRay> rays = medium_rays(world.voxels, full_or(300, 3000), seed);
    MediumBatch batch(world, rays);
    const std::vector<float> transmittance = batch.sight(1);
    for (size_t i = 0; i < rays.size(); ++i) {
        const double depth = depth_of(world, rays[i], density);
        for (int c = 0; c < 3; ++c) {
            const double tau = double(world.medium.absorption[c]) * depth;
            const double expected = tau > 87 ? 0 : std::exp(-tau);
            ASSERT_NEAR(transmittance[c * batch.batch.stride + i], expected,
                        expected * std::max(1e-6, 2.5e-7 * tau))
                << "seed " << seed << ", ray " << i << ", channel " << c << ", tau " << tau;
        }
    }
}

TEST(Medium, AConstantOneFollowsBeersLaw) {
    expect_beers_law(
        medium_world(kSize), [](const glm::dvec3&, const glm::ivec3&) { return 1.0; }, 1);
}

TEST(Medium, HeightFogIsSummedOverTheLayersThatARayPasses) {
    World world = medium_world(kSize);
    world.medium.density = HeightDensity{1.3, 2.1};
    expect_beers_law(
        world, [](const glm::dvec3& p, const glm::ivec3&) { return height_density(1.3, 2.1, p.y); },
        2);
}

TEST(Medium, ABallIsSummedOverTheVoxelsThatARayPasses) {
    for (const double falloff : {0.0, 3.5}) {
        World world = medium_world(kSize);
        const BallDensity ball{{12, 4, 17}, 9.2, falloff};
        world.medium.density = ball;
        expect_beers_law(
            world, [&](const glm::dvec3& p, const glm::ivec3&) { return ball_density(ball, p); },
            3);
    }
}

TEST(Medium, AThinLayerFarAwayCountsExactly) {
    // One of 4000 layers is dense; rays cross it at a slant, far from their origins.
    World world = medium_world({40, 4000, 40});
    world.medium.density = HeightDensity{-1 + 0.25 * 0.5, 0.01};  // e^-25 in the next voxel
    std::vector<MediumRay> rays;
    for (int i = 0; i < 64; ++i) {
        const glm::dvec3 d(0.002 * std::sin(i), -0.75, 5e-5 * i - 0.0015);
        rays.push_back({snapped({20.3 + 0.1 * i, 3900 + i, 15.1}, 12), snapped(d, 22)});
    }
    world.medium.color = {1, 1, 1};
    MediumBatch batch(world, rays);
    const std::vector<float> emitted = batch.sight(0);
    for (size_t i = 0; i < rays.size(); ++i) {
        const double depth = depth_of(world, rays[i], [](const glm::dvec3& p, const glm::ivec3&) {
            return height_density(-1 + 0.25 * 0.5, 0.01, p.y);
        });
        const double expected = -std::expm1(-depth * 0.25);
        ASSERT_GT(expected, 0) << i;
        EXPECT_NEAR(emitted[i], expected, 1e-6 * expected) << i;
    }
}

TEST(Medium, ItsOwnLightIsAccurateWhereItIsThin) {
    World world = medium_world(kSize);
    world.medium.color = {0.5, 2, 8};
    for (const float absorption : {1e-9f, 1e-7f, 1e-5f, 1e-3f, 0.1f, 1.0f, 5.0f}) {
        world.medium.absorption = glm::vec3(absorption);
        const MediumRay ray = {{0, 20.5, 10.5}, {0.75, 0, 0}};  // 35 m
        MediumBatch batch(world, {ray});
        const std::vector<float> emitted = batch.sight(0);
        for (int c = 0; c < 3; ++c) {
            const double expected =
                double(world.medium.color[c]) * -std::expm1(-35 * double(absorption));
            EXPECT_NEAR(emitted[c * batch.batch.stride], expected, 1e-6 * expected) << absorption;
        }
    }
}

TEST(Medium, O8NothingComesThroughAnOpticalDepthOfTwoHundred) {
    World world = medium_world(kSize);
    world.medium.absorption = {200.0f / 35, 87.5f / 35, 86.5f / 35};
    world.medium.color = {0.25, 0.5, 0.75};
    for (const bool grid : {false, true}) {
        if (grid) world.medium.density = BallDensity{{15, 5, 15}, 1000, 0};
        MediumBatch batch(world, {{{0, 20.5, 10.5}, {0.75, 0, 0}}});
        const size_t stride = batch.batch.stride;
        const std::vector<float> seen = batch.sight(1e37f);
        EXPECT_EQ(seen[0], 0.25f) << "its own light alone";
        EXPECT_EQ(seen[stride], 0.5f);
        EXPECT_GT(seen[2 * stride], 0.75f) << "e^-86.5 is a normal number";
        const std::vector<float> dim = batch.sight(1e-3f);
        EXPECT_EQ(dim[0], 0.25f);
    }
}

TEST(Medium, IdleRaysKeepTheirRadiance) {
    World world = medium_world(kSize);
    world.medium.color = {1, 1, 1};
    for (const bool grid : {false, true}) {
        if (grid) world.medium.density = HeightDensity{0, 5};
        MediumRay idle = {{3, 4, 5}, {0.75, 0.5, 0.25}};
        idle.t_end = -1;
        MediumBatch batch(world, {idle});
        EXPECT_EQ(batch.sight(0.3f)[0], 0.3f);
    }
}

TEST(Medium, HasTheSameBitsForEveryNumberOfLanes) {
    size_t turn = 0;
    for (const Density& density : {Density(std::monostate()), Density(HeightDensity{1.3, 2.1}),
                                   Density(BallDensity{{12, 4, 17}, 9.2, 3})}) {
        World world = medium_world(kSize);
        world.medium.density = density;
        world.medium.color = {0.1f, 0.2f, 0.3f};
        const std::vector<MediumRay> rays = medium_rays(kSize, full_or(100, 1000), 4);
        const std::vector<float> expected = MediumBatch(world, rays, 16).sight(1);
        for (const int lanes : in_turn<int>({1, 4, 8}, turn++))
            EXPECT_EQ(MediumBatch(world, rays, lanes).sight(1), expected) << lanes;
    }
}

TEST(Medium, O8AMillionSegmentsAreSummedToAFloatsAccuracy) {
    const uint32_t count = full_or(10'000, 1'000'000);
    const Device device = test_device();
    const Program program = Program::from_text(device, R"(
#include "lib/traverse/density.h"
#include "lib/lanes/work_item.h"
kernel void sum_up(global const float* terms, uint count, global float* result) {
    if (work_item() > 0) return;
    lane_float sum = (lane_float)0.0f, lost = (lane_float)0.0f;
    for (uint i = 0; i < count; ++i) add_exactly(&sum, &lost, (lane_float)terms[i], (lane_int)-1);
    LANES_STORE(sum - lost, result, 0);
})");
    std::mt19937 random(5);
    std::vector<float> terms(count);
    double exact = 0;
    for (float& term : terms) {
        term = std::exp2(std::uniform_real_distribution<float>(-24, 3)(random));
        exact += double(term);
    }
    const Buffer<float> input(device, "terms", std::span<const float>(terms));
    Buffer<float> result(device, "sum", 16);
    program.kernel("sum_up").launch(WorkItem::light, 1, input, count, result);
    EXPECT_NEAR(result.read_one(0), exact, 6e-8 * exact);
}

TEST(Medium, ShadowRaysLoseLightToItsDensity) {
    World world = medium_world(kSize);
    const BallDensity ball{{12, 4, 17}, 9.2, 3.5};
    world.medium.density = ball;
    std::vector<MediumRay> rays = medium_rays(kSize, 500, 6);
    for (MediumRay& ray : rays) ray.t_hit = -1;
    for (size_t i = 0; i < rays.size(); i += 3) rays[i].t_end = INFINITY;  // directional light
    for (const bool shadows : {true, false}) {
        Features features;
        features.shadows = shadows;
        MediumBatch batch(world, rays, 0, features);
        const uint32_t stride = batch.batch.stride;
        ShadowQueue queue;
        queue.count = Buffer<uint32_t>(batch.device, "queue", 1);
        queue.count.fill(batch.count);
        queue.rays = batch.batch.rays;
        std::vector<uint32_t> targets(stride);
        for (uint32_t i = 0; i < stride; ++i) targets[i] = batch.count - 1 - i;
        queue.targets = Buffer<uint32_t>(batch.device, "queue", std::span<const uint32_t>(targets));
        queue.contributions = Buffer<float>(batch.device, "queue", 3 * stride);
        queue.contributions.fill(0.5f);
        batch.batch.radiance.fill(0.125f);
        batch.stage().shadows(batch.pyramid, queue, batch.count, batch.batch);
        const std::vector<float> contributions = queue.contributions.read();
        const std::vector<float> radiance = batch.batch.radiance.read();
        for (uint32_t i = 0; i < batch.count; ++i) {
            const double depth = depth_of(
                world, rays[i],
                [&](const glm::dvec3& p, const glm::ivec3&) { return ball_density(ball, p); });
            for (uint32_t c = 0; c < 3; ++c) {
                const double expected =
                    0.5 * std::exp(-double(world.medium.absorption[int(c)]) * depth);
                const size_t target = c * stride + targets[i];
                if (shadows) {
                    ASSERT_NEAR(contributions[c * stride + i], expected, 4e-6 * expected) << i;
                }
                ASSERT_NEAR(radiance[target], shadows ? 0.125 : 0.125 + expected, 2e-6) << i;
            }
        }
    }
}

TEST(Medium, OnPathsASegmentGoesThroughTheObjectItIsInside) {
    World world = medium_world(kSize);
    world.medium.density = HeightDensity{1.3, 2.1};
    world.medium.color = {1, 1, 1};
    Features features;
    features.paths = features.transmission = true;
    MediumRay ray = {{0.5, 3.25, 4.5}, {0.75, 0.25, 0.125}};
    ray.t_hit = 40;
    MediumBatch batch(world, {ray, ray}, 0, features);
    const uint32_t stride = batch.batch.stride;
    std::vector<MaterialRecord> records(3);
    records[2].absorption[1] = 0.125f;
    batch.materials =
        Buffer<MaterialRecord>(batch.device, "m", std::span<const MaterialRecord>(records));
    std::vector<float> starts(stride, 0);
    starts[0] = starts[1] = 12.3f;
    batch.batch.starts = Buffer<float>(batch.device, "starts", std::span<const float>(starts));
    std::vector<uint32_t> inside(stride, 0);
    inside[1] = 3;  // material 2
    batch.batch.inside =
        Buffer<uint32_t>(batch.device, "inside", std::span<const uint32_t>(inside));
    batch.batch.transmittance = Buffer<float>(batch.device, "transmittance", 3 * stride);
    const std::vector<float> seen = batch.sight(0.5f);
    const std::vector<float> transmittance = batch.batch.transmittance.read();

    const DensityAt density = [](const glm::dvec3& p, const glm::ivec3&) {
        return height_density(1.3, 2.1, p.y);
    };
    MediumRay before = ray;
    before.t_hit = 12.3f;
    const double depth = depth_of(world, ray, density) - depth_of(world, before, density);
    const double in_environment = std::exp(-depth / 32);
    EXPECT_NEAR(transmittance[stride], in_environment, 1e-6 * in_environment);
    EXPECT_NEAR(seen[stride], in_environment * 0.5 + 1 - in_environment, 1e-6);
    const double metres = (40 - double(12.3f)) * glm::length(ray.d * world.voxel_size);
    const double in_glass = std::exp(-metres / 8);
    EXPECT_NEAR(transmittance[stride + 1], in_glass, 1e-6 * in_glass);
    EXPECT_NEAR(seen[stride + 1], in_glass * 0.5, 1e-6);
    EXPECT_EQ(transmittance[1], 1.0f) << "the material absorbs green alone";
    EXPECT_EQ(seen[1], 0.5f);
}

}  // namespace
}  // namespace voxelume
