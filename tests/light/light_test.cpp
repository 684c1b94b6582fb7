// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light.hpp"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/stages/trace/trace.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kRays = 48;

/// A batch of 48 ray slots in a world of 40 x 30 x 20 voxels of 0.5 x 0.25 x 1 m. Rays 3, 17 and 40
/// hit voxel (10, 8, 5), which faces up.
class Lit {
  public:
    Lit() : device_(test_device()) {
        pyramid.frame = {{0, 0, 0}, {0.5, 0.25, 1}, {40, 30, 20}};
        batch.stride = kRays;
        std::vector<uint32_t> hits(kRays * VXL_HIT_PRIMITIVE, VXL_NO_VOXEL);
        std::vector<float> positions(3 * kRays, 0), normals = positions, rays(7 * kRays, 0);
        for (const uint32_t ray : {3u, 17u, 40u}) {
            hits[VXL_HIT_VOXEL * kRays + ray] = ray;
            positions[ray] = 10, positions[kRays + ray] = 8, positions[2 * kRays + ray] = 5;
            normals[kRays + ray] = 1;
            rays[VXL_RAY_DY * kRays + ray] = -1;  // seen from straight above
        }
        batch.rays = Buffer<float>(device_, "rays", std::span<const float>(rays));
        batch.hits = Buffer<uint32_t>(device_, "hits", std::span<const uint32_t>(hits));
        batch.positions = Buffer<float>(device_, "positions", std::span<const float>(positions));
        batch.normals = Buffer<float>(device_, "normals", std::span<const float>(normals));
        batch.hit_attributes = Buffer<uint32_t>(device_, "hit attributes", kRays);
        batch.hit_attributes.fill(0);
        batch.radiance = Buffer<float>(device_, "radiance", 3 * kRays);
        batch.radiance.fill(0);
        queue.count = Buffer<uint32_t>(device_, "queue", 1);
        queue.rays = Buffer<float>(device_, "queue", 7 * kRays);
        queue.targets = Buffer<uint32_t>(device_, "queue", kRays);
        queue.contributions = Buffer<float>(device_, "queue", 3 * kRays);
        material.color = {0.5f, 0.25f, 1};
        material.diffuse = 0.5f;
    }

    /// Adds a light; returns the number of queued shadow rays.
    uint32_t add(const Light& light) {
        features.shadows = true;
        const MaterialRecord record = material_of();
        const Buffer<MaterialRecord> materials(device_, "materials",
                                               std::span<const MaterialRecord>(&record, 1));
        LightStage stage(device_, features, materials);
        stage.add(pyramid, light_record(light, pyramid.frame), batch, kRays, queue);
        return queue.count.read_one(0);
    }

    Pyramid pyramid;
    RayBatch batch;
    ShadowQueue queue;
    Material material;
    Features features;

  private:
    MaterialRecord material_of() const {
        MaterialRecord record{};
        for (int i = 0; i < 3; ++i) record.color[i] = material.color[i];
        record.diffuse = material.diffuse;
        return record;
    }

    Device device_;
};

Light point_light(const glm::dvec3& position) {
    Light light;
    light.position = position;
    light.intensity = {2, 4, 8};
    return light;
}

TEST(Light, QueuesARayToTheLightForEveryPointThatFacesIt) {
    Lit lit;
    // The points lie at (5, 2, 5) m, the light 3 m above and 4 m along z: 5 m away, with cosine
    // 0.6.
    ASSERT_EQ(lit.add(point_light({5, 5, 9})), 3u);
    std::vector<uint32_t> targets = lit.queue.targets.read(0, 3);
    std::ranges::sort(targets);
    EXPECT_EQ(targets, (std::vector<uint32_t>{3, 17, 40}));
    const std::vector<float> rays = lit.queue.rays.read(),
                             contributions = lit.queue.contributions.read();
    // (0, 3, 4) m is (0, 12, 4) voxels, scaled by 1/16 so that the largest component lies in [1/2,
    // 1).
    EXPECT_EQ(rays[VXL_RAY_OX * kRays], 10.0f);
    EXPECT_EQ(rays[VXL_RAY_OY * kRays], 8.0f);
    EXPECT_EQ(rays[VXL_RAY_OZ * kRays], 5.0f);
    EXPECT_EQ(rays[VXL_RAY_DX * kRays], 0.0f);
    EXPECT_EQ(rays[VXL_RAY_DY * kRays], 0.75f);
    EXPECT_EQ(rays[VXL_RAY_DZ * kRays], 0.25f);
    EXPECT_EQ(rays[VXL_RAY_END * kRays], 16.0f);
    const double factor = 0.6 * 0.5 / 25;  // cosine, diffuse, 1/d²
    EXPECT_NEAR(contributions[0], 2 * 0.5 * factor, 1e-8);
    EXPECT_NEAR(contributions[kRays], 4 * 0.25 * factor, 1e-8);
    EXPECT_NEAR(contributions[2 * kRays], 8 * 1 * factor, 1e-8);
    for (const float value : lit.batch.radiance.read()) EXPECT_EQ(value, 0.0f);
}

TEST(Light, QueuesNothingForALightBehindTheSurfaceOrOnIt) {
    Lit lit;
    EXPECT_EQ(lit.add(point_light({5, 1, 9})), 0u);
    EXPECT_EQ(lit.add(point_light({7, 2, 9})), 0u) << "in the surface's plane";
    EXPECT_EQ(lit.add(point_light({5, 2, 5})), 0u) << "at the point itself";
}

TEST(Light, QueuesNothingForABlackMaterial) {
    Lit lit;
    lit.material.color = {0, 0, 0};
    EXPECT_EQ(lit.add(point_light({5, 5, 9})), 0u);
}

TEST(Light, ADirectionalLightHasNoDistance) {
    Lit lit;
    Light sun;
    sun.kind = LightKind::directional;
    sun.direction = {0, -1, 0};
    sun.intensity = {1, 1, 1};
    ASSERT_EQ(lit.add(sun), 3u);
    EXPECT_TRUE(std::isinf(lit.queue.rays.read_one(VXL_RAY_END * kRays)));
    EXPECT_NEAR(lit.queue.contributions.read_one(0), 0.25, 1e-7);
}

TEST(Light, ASpotShinesInsideItsConeAndSmoothlyUpToItsEdge) {
    Lit lit;
    Light spot = point_light({5, 4, 5});  // 2 m above
    spot.kind = LightKind::spot;
    spot.inner_half_angle = 0.4;
    spot.outer_half_angle = 0.6;
    spot.intensity = {1, 1, 1};
    const auto aimed = [&](double angle) {
        spot.direction = {std::sin(angle), -std::cos(angle), 0};
        return lit.add(spot) == 0 ? 0.0f : lit.queue.contributions.read_one(0);
    };
    const float full = 0.25f / 4;
    EXPECT_NEAR(aimed(0.3), full, 1e-7);
    EXPECT_EQ(aimed(0.7), 0.0f);
    const double s = (std::cos(0.5) - std::cos(0.6)) / (std::cos(0.4) - std::cos(0.6));
    EXPECT_NEAR(aimed(0.5), full * s * s * (3 - 2 * s), 1e-6);
}

TEST(Light, AHardSpotIsAllOrNothing) {
    Lit lit;
    Light spot = point_light({5, 4, 5});
    spot.kind = LightKind::spot;
    spot.inner_half_angle = spot.outer_half_angle = 0.5;
    spot.intensity = {1, 1, 1};
    spot.direction = {std::sin(0.45), -std::cos(0.45), 0};
    ASSERT_EQ(lit.add(spot), 3u);
    EXPECT_NEAR(lit.queue.contributions.read_one(0), 0.25 / 4, 1e-7);
    spot.direction = {std::sin(0.55), -std::cos(0.55), 0};
    EXPECT_EQ(lit.add(spot), 0u);
}

TEST(Light, ThatTurnsFromTheWorldMayNotLightIt) {
    GridFrame world;
    world.size = {40, 20, 10};
    world.voxel_edge = {0.25, 0.5, 1};  // 10 metres along each axis
    Light spot = point_light({5, 30, 5});
    spot.kind = LightKind::spot;
    spot.inner_half_angle = 0.05, spot.outer_half_angle = 0.1;
    const auto may = [&](const glm::dvec3& direction) {
        spot.direction = glm::normalize(direction);
        return may_light(light_record(spot, world), world);
    };
    EXPECT_TRUE(may({0, -1, 0}));
    EXPECT_TRUE(may({6, -20, 0})) << "a corner's side";
    EXPECT_FALSE(may({20, -20, 0}));
    EXPECT_FALSE(may({0, 1, 0}));
    spot.position = {5, 12, 5};
    EXPECT_TRUE(may({0, 1, 0})) << "too near to be told apart";
    spot.position = {5, 30, 5};
    spot.outer_half_angle = 3;
    EXPECT_TRUE(may({0, 1, 0.4}));

    LightRecord area_sample = light_record(point_light({5, 30, 5}), world);
    area_sample.kind = VXL_LIGHT_AREA_SAMPLE;
    area_sample.direction = {0, -1, 0, 0};
    EXPECT_TRUE(may_light(area_sample, world));
    area_sample.direction = {0, 1, 0, 0};
    EXPECT_FALSE(may_light(area_sample, world));
    area_sample.direction = {1, 0, 0, 0};
    EXPECT_TRUE(may_light(area_sample, world)) << "half of the world is before it";
    EXPECT_TRUE(may_light(light_record(point_light({5, 30, 5}), world), world));
}

}  // namespace
}  // namespace voxelume
