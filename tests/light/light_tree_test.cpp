// SPDX-License-Identifier: Apache-2.0
// The tree of many lights: what its nodes say of the lights below them.
#include "runtime/stages/light/light_tree.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numeric>
#include <random>

#include "runtime/opencl/float4.hpp"

namespace voxelume {
namespace {

constexpr glm::dvec3 kVoxelEdges{0.02, 0.0173, 0.0214};

GridFrame world_of_lights() {
    GridFrame world;
    world.size = glm::ivec3(300, 200, 100);
    world.voxel_edge = kVoxelEdges;
    return world;
}

/// Points and spots at random, of which some lie on one another.
std::vector<PathLight> random_lights(int count, std::mt19937& random) {
    std::uniform_real_distribution<float> any(-1, 1);
    std::vector<PathLight> lights;
    for (int i = 0; i < count; ++i) {
        LightRecord light{};
        const glm::vec3 along =
            glm::normalize(glm::vec3(any(random), any(random), any(random)) + glm::vec3(1e-3f));
        light.position = {400 * any(random), 200 * any(random), 100 * any(random), 0};
        if (i > 0 && random() % 4 == 0) light.position = lights.back().record.position;
        light.direction = {along.x, along.y, along.z, 0};
        light.intensity = {1 + any(random), 1 + any(random), 1 + any(random), 0};
        light.kind = random() % 3 == 0 ? VXL_LIGHT_POINT : VXL_LIGHT_SPOT;
        light.outer_cosine = any(random);
        light.inner_cosine = light.outer_cosine + 0.5f * (1 - light.outer_cosine);
        lights.push_back({light, {}, 0});
    }
    return lights;
}

glm::dvec3 metres_of(const float* middle) {
    return glm::dvec3(middle[0], middle[1], middle[2]) * kVoxelEdges;
}

/// Fails unless a node's ball and cone hold the light of a leaf.
void expect_holds(const LightNode& node, const LightRecord& light, double rounding = 1e-12) {
    const glm::dvec3 at =
        glm::dvec3(light.position.x, light.position.y, light.position.z) * kVoxelEdges;
    EXPECT_LE(glm::distance(at, metres_of(node.middle)), double(node.radius) + rounding);
    if (node.cosine <= -1) return;
    ASSERT_GE(light.outer_cosine, -1);  // a spot
    const glm::dvec3 axis(node.axis[0], node.axis[1], node.axis[2]);
    const glm::dvec3 along(light.direction.x, light.direction.y, light.direction.z);
    const double widest = std::acos(std::clamp(double(node.cosine), -1.0, 1.0));
    EXPECT_LE(std::acos(std::clamp(glm::dot(axis, along), -1.0, 1.0)) +
                  std::acos(double(light.outer_cosine)),
              widest + 1e-6);
}

TEST(LightTree, NodesHoldTheLightsBelowThem) {
    std::mt19937 random(20261129);
    for (const int count : {1, 2, 3, 9, 16, 100, 300}) {
        const std::vector<PathLight> lights = random_lights(count, random);
        const LightTreeContent tree = light_tree_of(lights, world_of_lights());
        const size_t leaves = tree.lights.size();
        ASSERT_EQ(tree.nodes.size(), 2 * leaves);
        double listed = 0;
        for (size_t leaf = 0; leaf < leaves; ++leaf) {
            const LightNode& own = tree.nodes[leaves + leaf];
            if (own.power == 0) continue;
            ++listed;
            EXPECT_EQ(own.radius, 0);
            for (size_t node = leaves + leaf; node > 0; node /= 2)
                expect_holds(tree.nodes[node], tree.lights[leaf]);
        }
        EXPECT_EQ(listed, count);
        for (size_t node = 1; node < leaves; ++node)
            EXPECT_NEAR(tree.nodes[node].power,
                        tree.nodes[2 * node].power + tree.nodes[2 * node + 1].power, 1e-6);
        EXPECT_NEAR(tree.nodes[1].power, 1, 1e-5);
    }
}

TEST(LightTree, EveryLightIsListedOnceAndPointsAsSpotsOfAllDirections) {
    std::mt19937 random(3);
    const std::vector<PathLight> lights = random_lights(40, random);
    const LightTreeContent tree = light_tree_of(lights, world_of_lights());
    std::vector<float> expected, found;
    for (const PathLight& light : lights) expected.push_back(light.record.intensity.x);
    for (size_t leaf = 0; leaf < tree.lights.size(); ++leaf) {
        if (tree.nodes[tree.lights.size() + leaf].power == 0) continue;
        found.push_back(tree.lights[leaf].intensity.x);
        EXPECT_EQ(tree.lights[leaf].kind, VXL_LIGHT_SPOT);
    }
    EXPECT_THAT(found, testing::UnorderedElementsAreArray(expected));
}

/// Disks and rectangles at random, some of them large.
std::vector<PathLight> random_areas(int count, std::mt19937& random) {
    std::uniform_real_distribution<float> any(-1, 1);
    std::vector<PathLight> lights = random_lights(count, random);
    for (PathLight& light : lights) {
        light.record.kind = VXL_LIGHT_AREA_SAMPLE;
        LightAreaRecord area{};
        const auto axis = [&] { return glm::dvec3(any(random), any(random), any(random)); };
        const glm::dvec3 x = axis() * (random() % 3 == 0 ? 2.0 : 0.1);  // metres
        const glm::dvec3 y = glm::cross(x, axis());
        area.axis_x = to_float4(x / kVoxelEdges);
        area.axis_x.w = random() % 2 == 0 ? 1.0f : 0.0f;
        area.axis_y = to_float4(y / kVoxelEdges);
        light.area = area;
    }
    return lights;
}

TEST(LightTree, NodesHoldTheAreasBelowThem) {
    std::mt19937 random(20261130);
    for (const int count : {1, 2, 9, 100}) {
        const std::vector<PathLight> lights = random_areas(count, random);
        const LightTreeContent tree = light_tree_of(lights, world_of_lights());
        const size_t leaves = tree.lights.size();
        ASSERT_EQ(tree.areas.size(), leaves);
        int narrow = 0;
        for (size_t leaf = 0; leaf < leaves; ++leaf) {
            if (tree.nodes[leaves + leaf].power == 0) continue;
            LightRecord light = tree.lights[leaf];
            EXPECT_EQ(light.kind, VXL_LIGHT_AREA_SAMPLE);
            light.outer_cosine = 0;  // of the half of the space before the light
            const float4 middle = light.position, x = tree.areas[leaf].axis_x,
                         y = tree.areas[leaf].axis_y;
            for (size_t node = leaves + leaf; node > 0; node /= 2) {
                narrow += tree.nodes[node].cosine > -1;
                // Points of the rim, or corners.
                for (int corner = 0; corner < 8; ++corner) {
                    const double angle = 0.785398 * (corner + 0.5);
                    const bool is_round = x.w != 0;
                    const float a = is_round ? float(std::cos(angle)) : corner & 1 ? 1.0f : -1.0f;
                    const float b = is_round ? float(std::sin(angle)) : corner & 2 ? 1.0f : -1.0f;
                    light.position = {middle.x + a * x.x + b * y.x, middle.y + a * x.y + b * y.y,
                                      middle.z + a * x.z + b * y.z, 0};
                    // As floats, 600 voxels of 0.0214 m are off by 0.65e-6 m in each coordinate.
                    expect_holds(tree.nodes[node], light, 1.2e-6);
                }
            }
        }
        EXPECT_GE(narrow, count);
    }
}

}  // namespace
}  // namespace voxelume
