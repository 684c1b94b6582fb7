// SPDX-License-Identifier: Apache-2.0
#include "runtime/analysis/culling_hull.hpp"

#include <gtest/gtest.h>

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/vector_relational.hpp>
#include <random>

#include "runtime/stages/trace/sight.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kHullSeed = 20261123;

/// A world of 70 x 37 x 130 voxels of 0.1 x 0.2 x 0.05 m.
const GridFrame kWorld = {{-3, -4, -2}, {0.1, 0.2, 0.05}, {70, 37, 130}};

class Random {
  public:
    double in(double low, double high) {
        return std::uniform_real_distribution<double>(low, high)(random_);
    }
    glm::dvec3 in(const glm::dvec3& low, const glm::dvec3& high) {
        return {in(low.x, high.x), in(low.y, high.y), in(low.z, high.z)};
    }
    glm::dvec3 direction() { return glm::normalize(in(glm::dvec3(-1), glm::dvec3(1)) + 1e-3); }

  private:
    std::mt19937 random_{kHullSeed};
};

VoxelBox around(const glm::dvec3& point, double radius) {
    return {point - radius, point + radius};
}

Observer random_observer(DisplayShape shape, Random& random) {
    Observer observer;
    observer.position = random.in({-9, -9, -9}, {9, 9, 9});
    const glm::dvec3 target = random.in({-3, -4, -2}, {4, 3.4, 4.5});
    const glm::dvec3 z = glm::normalize(target - observer.position);
    const glm::dvec3 x = glm::normalize(glm::cross(random.direction(), z));
    observer.world_from_observer = glm::dmat3(x, glm::cross(z, x), z);
    Display& display = observer.display;
    display.shape = shape;
    display.half_angles = {random.in(0.02, 1.2), random.in(0.02, 1.2)};
    if (shape == DisplayShape::sector) display.half_angles = glm::dvec2(random.in(0.02, 3));
    display.half_size = {random.in(0.1, 3), random.in(0.1, 3)};
    display.near = shape == DisplayShape::ball ? 0 : random.in(0, 3);
    display.far = display.near + random.in(1, 20);
    return observer;
}

/// The rays that the observer's kernel casts in an empty world.
std::vector<float> cast_rays(const Device& device, const Observer& observer, uint32_t& count) {
    Scene scene;
    scene.observer = observer;
    scene.render.size = {16, 12};
    Pyramid world;
    world.frame = kWorld;
    RayBatch batch;
    batch.stride = count = tile_count(16, 12) * 16;
    batch.rays = Buffer<float>(device, "rays", size_t(count) * VXL_RAY_COMPONENTS);
    SightStage(device, {}, camera_of(scene, kWorld))
        .cast(shape_of(world), 0, tile_count(16, 12), batch);
    return batch.rays.read();
}

TEST(CullingHull, HoldsWhatSightRaysPassOfTheWorld) {
    const Device device = test_device();
    Random random;
    for (int trial = 0; trial < 40; ++trial)
        for (const DisplayShape shape :
             {DisplayShape::pyramid, DisplayShape::sector, DisplayShape::ball, DisplayShape::box}) {
            const Observer observer = random_observer(shape, random);
            const Hull hull = hull_of_sight_rays(observer, kWorld);
            uint32_t count = 0;
            const std::vector<float> rays = cast_rays(device, observer, count);
            const auto value = [&](uint32_t component, uint32_t ray) {
                return double(rays[component * count + ray]);
            };
            for (uint32_t i = 0; i < count; ++i) {
                const double end = value(VXL_RAY_END, i);
                if (end < 0) continue;
                const glm::dvec3 o(value(0, i), value(1, i), value(2, i));
                const glm::dvec3 d(value(3, i), value(4, i), value(5, i));
                for (const double share : {0.0, 0.1, 0.3, 0.7, 1.0}) {
                    const glm::dvec3 p = o + d * std::min(end, 300.0) * share;
                    if (p != glm::clamp(p, glm::dvec3(0), glm::dvec3(kWorld.size))) continue;
                    ASSERT_FALSE(are_apart(hull, around(p, 0), 0.1))
                        << "seed " << kHullSeed << ", trial " << trial << ", shape " << int(shape)
                        << ", ray " << i;
                }
            }
        }
}

TEST(CullingHull, OfANarrowViewIsApartFromWhatStandsNextToIt) {
    Observer observer;  // looks along z from the middle of the world's side
    observer.position = {0.5, -0.3, -2};
    observer.display.half_angles = {0.1, 0.1};
    observer.display.far = 5;
    const Hull hull = hull_of_sight_rays(observer, kWorld);
    EXPECT_FALSE(are_apart(hull, around({35, 18.5, 65}, 2), 1));
    EXPECT_TRUE(are_apart(hull, around({55, 18.5, 65}, 2), 1)) << "beside";
    EXPECT_TRUE(are_apart(hull, around({35, 33, 65}, 2), 1)) << "above";
    EXPECT_TRUE(are_apart(hull, around({35, 18.5, 125}, 2), 1)) << "beyond the far surface";
    EXPECT_FALSE(are_apart(hull, around({35, 18.5, 99}, 2), 1));
}

/// A scene that views the world's first quarter along z, 0.1 rad to each side.
Scene scene_with(const Light& light) {
    Scene scene;
    scene.observer.position = {0.5, -0.3, -2};
    scene.observer.display.half_angles = {0.1, 0.1};
    scene.observer.display.far = 1.6;
    scene.lights = {light};
    return scene;
}

Hull lit_hull(const Scene& scene, const std::vector<VoxelBox>& emissive_objects = {}) {
    Hull hull = hull_of_sight_rays(scene.observer, kWorld);
    add_shadow_rays(scene, emissive_objects, kWorld, hull);
    return hull;
}

TEST(CullingHull, GoesOnToALightThatIsSomewhere) {
    Light light;
    light.position = {3.5, -0.3, -1};  // voxel (65, 18.5, 20)
    const Hull hull = lit_hull(scene_with(light));
    EXPECT_FALSE(are_apart(hull, around({55, 18.5, 20}, 2), 1)) << "on the way to it";
    EXPECT_TRUE(are_apart(hull, around({15, 18.5, 20}, 2), 1)) << "on the other side";
    EXPECT_TRUE(are_apart(hull, around({55, 18.5, 100}, 2), 1));
    light.kind = LightKind::disk;
    light.radius = 1;
    EXPECT_FALSE(are_apart(lit_hull(scene_with(light)), around({65, 22, 20}, 1), 1));
    light.intensity = glm::vec3(0);
    EXPECT_TRUE(are_apart(lit_hull(scene_with(light)), around({55, 18.5, 20}, 2), 1));
    EXPECT_FALSE(are_apart(lit_hull(scene_with(light), {around({65, 18, 20}, 3)}),
                           around({55, 18.5, 20}, 2), 1));
}

TEST(CullingHull, GoesOnToADistantLightAsFarAsTheWorld) {
    Light light;
    light.kind = LightKind::directional;
    light.direction = glm::normalize(glm::dvec3(-1, -0.1, -1));
    const Hull hull = lit_hull(scene_with(light));
    // One metre is 10 voxels along x and 20 along z.
    EXPECT_FALSE(are_apart(hull, around({65, 20, 80}, 2), 1));
    EXPECT_TRUE(are_apart(hull, around({65, 20, 10}, 2), 1));
    EXPECT_TRUE(are_apart(hull, around({15, 18, 65}, 2), 1));
}

TEST(CullingHull, IsNeverSaidToBeApartFromABoxThatHoldsAPointOfIt) {
    Random random;
    int apart = 0;
    for (int trial = 0; trial < 20000; ++trial) {
        Hull hull;
        for (int i = 0; i < 8; ++i) hull.push_back(random.in(glm::dvec3(-20), glm::dvec3(20)));
        const glm::dvec3 low = random.in(glm::dvec3(-40), glm::dvec3(40));
        const VoxelBox box = {low, low + random.in(glm::dvec3(0), glm::dvec3(20))};
        if (!are_apart(hull, box, 0.01)) continue;
        ++apart;
        for (int sample = 0; sample < 20; ++sample) {
            glm::dvec3 p(0);
            double sum = 0;
            for (const glm::dvec3& corner : hull) {
                const double share = -std::log(random.in(1e-9, 1));
                p += share * corner, sum += share;
            }
            p /= sum;
            ASSERT_NE(p, glm::clamp(p, box.low, box.high)) << "seed " << kHullSeed << ", " << trial;
        }
    }
    EXPECT_GT(apart, 8000);
}

}  // namespace
}  // namespace voxelume
