// SPDX-License-Identifier: Apache-2.0
// Instances show what the world's voxels show where both have the same voxels, and otherwise show
// their own models.
#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <random>

#include "runtime/base/error.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

class Instances : public testing::TestWithParam<const char*> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, Instances, testing::Values("cubes", "smooth", "exact"));

/// The number of pixels whose colours differ by more than 1e-5.
size_t count_different(const Image& a, const Image& b) {
    size_t count = 0;
    for (size_t i = 0; i < a.planes.at("R").size(); ++i) {
        const auto differs = [&](const char* channel) {
            return std::abs(a.planes.at(channel)[i] - b.planes.at(channel)[i]) > 1e-5;
        };
        count += differs("R") || differs("G") || differs("B");
    }
    return count;
}

TEST_P(Instances, WholeVoxelPlacementsShowTheWorldsImage) {
    Scene baked = instance_scene(GetParam(), "world", whole_voxel_objects());
    Scene instanced = instance_scene(GetParam(), "instance", whole_voxel_objects());
    for (const bool has_light_rays : {true, false}) {
        for (Scene* scene : {&baked, &instanced}) {
            scene->render.shadows = has_light_rays;
            scene->render.depth = has_light_rays ? 2 : 0;
        }
        const Image world = image_of_scene(baked), own = image_of_scene(instanced);
        EXPECT_EQ(own.id_planes.at("objectId"), world.id_planes.at("objectId"));
        EXPECT_EQ(own.planes.at("A"), world.planes.at("A"));
        size_t seen = 0;
        for (size_t i = 0; i < own.planes.at("R").size(); ++i) {
            if (world.id_planes.at("objectId")[i] == 0) continue;
            ++seen;
            EXPECT_LT(glm::distance(vector_at(own, "N", i), vector_at(world, "N", i)), 1e-5) << i;
            EXPECT_LT(glm::distance(vector_at(own, "P", i), vector_at(world, "P", i)), 1e-6) << i;
        }
        EXPECT_GT(seen, 10'000u);
        // Shadow and reflected rays leave an instance a thousandth of a voxel above it, and an edge
        // may fall between.
        EXPECT_LE(count_different(own, world), has_light_rays ? seen / 2000 : 0);
    }
}

struct MeshSurface {
    const char* surface;
    const char* set;  ///< in JSON
};

class InstancesOfAMesh : public FileTest, public testing::WithParamInterface<MeshSurface> {};
INSTANTIATE_TEST_SUITE_P(Surfaces, InstancesOfAMesh,
                         testing::Values(MeshSurface{"cubes", R"(, "set": "supercover")"},
                                         MeshSurface{"cubes", R"(, "set": "thin")"},
                                         MeshSurface{"cubes", R"(, "set": "solid")"},
                                         MeshSurface{"smooth", ""}, MeshSurface{"exact", ""}));

/// A mesh whose bounds are no multiples of a voxel.
TEST_P(InstancesOfAMesh, WholeVoxelPlacementsShowTheWorldsImage) {
    write_obj(folder / "ring.obj", wavy_ring(48, 24));
    for (const char* place : {R"("position": [0, 0, 0])", R"("position": [-0.5, 0.1, 0.05])",
                              R"("position": [0.1, 0.1, 0.05], "turn": [90, 0, 0])",
                              R"("position": [0.1, 0.1, 0.05], "scale": [-1, 1, 1])"}) {
        const auto image = [&](const char* placement) {
            return image_of_scene(
                parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1.8, -1.8, -1.8], "max": [1.8, 1.8, 1.8]}},
          "ambient": [0.3, 0.3, 0.3]}},
"models": {{"ring": {{"mesh": "ring.obj", "surface": "{}"{}, "voxel_size": 0.05}}}},
"objects": [{{"model": "ring", "placement": "{}", {}}}],
"lights": [{{"type": "point", "position": [1, 2, -3], "intensity": 12}}],
"observer": {{"position": [0.2, 0.3, -2.5], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [40, 30]}}}},
"render": {{"size": [96, 72], "shadows": false}}}})",
                                        GetParam().surface, GetParam().set, placement, place),
                            folder / "scene.json", {}));
        };
        const Image world = image("world"), own = image("instance");
        EXPECT_EQ(own.id_planes.at("objectId"), world.id_planes.at("objectId")) << place;
        size_t seen = 0;
        for (size_t i = 0; i < own.planes.at("R").size(); ++i) {
            if (world.id_planes.at("objectId")[i] == 0) continue;
            ++seen;
            EXPECT_LT(glm::distance(vector_at(own, "P", i), vector_at(world, "P", i)), 1e-5)
                << place << i;
        }
        EXPECT_GT(seen, 500u);
        EXPECT_EQ(count_different(own, world), 0u) << place;
    }
}

/// The hits lie on the ellipsoid's surface that a map makes of a ball.
TEST(Instance, TurnedAndShearedBallsLieWhereTheirMapsPutThem) {
    for (const auto& [surface, bound] : {std::pair{"exact", 2e-6}, std::pair{"smooth", 1.5e-4}}) {
        const Scene scene = instance_scene(surface, "instance", turned_objects());
        const Image image = image_of_scene(scene);
        size_t seen = 0;
        for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
            const uint32_t object = image.id_planes.at("objectId")[i];
            if (object != 1 && object != 3 && object != 4) continue;
            const glm::dmat4 inverse = glm::inverse(scene.objects[object - 1].world_from_object);
            const glm::dvec3 p(inverse * glm::dvec4(vector_at(image, "P", i), 1.0));
            ASSERT_NEAR(glm::length(p), 0.2, bound) << surface << " pixel " << i;
            const glm::dvec3 normal =
                glm::normalize(glm::transpose(glm::dmat3(inverse)) * glm::normalize(p));
            ASSERT_LT(glm::distance(vector_at(image, "N", i), normal), 100 * bound)
                << surface << " pixel " << i;
            ++seen;
        }
        EXPECT_GT(seen, 3000u);
    }
}

TEST(Instance, TheNearestOfManyIsSeen) {
    std::mt19937 random(411);
    std::uniform_real_distribution<double> place(-0.6, 0.6), size(0.1, 0.8), turn(0, 360);
    std::vector<std::string> objects;
    for (int i = 0; i < 70; ++i)
        objects.push_back(fmt::format(
            R"("model": "ball", "position": [{}, {}, {}], "turn": [{}, {}, {}], "scale": [{}, {}, {}])",
            place(random), place(random), place(random), turn(random), turn(random), turn(random),
            size(random), size(random), size(random)));
    const Scene scene = instance_scene("exact", "instance", objects);
    const Image image = image_of_scene(scene);
    const glm::dvec3 eye = scene.observer.position;
    size_t seen = 0;
    for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
        const uint32_t shown = image.id_planes.at("objectId")[i];
        if (shown == 0 || shown > objects.size()) continue;
        ++seen;
        const glm::dvec3 hit = vector_at(image, "P", i);
        // In double precision the ray hits no object before the rendered hit by more than rounding.
        for (size_t o = 0; o < objects.size(); ++o) {
            const glm::dmat4 inverse = glm::inverse(scene.objects[o].world_from_object);
            const glm::dvec3 a(inverse * glm::dvec4(eye, 1.0));
            const glm::dvec3 b = glm::dvec3(inverse * glm::dvec4(hit, 1.0)) - a;
            const double half = glm::dot(a, b), squared = glm::dot(b, b);
            const double root = half * half - squared * (glm::dot(a, a) - 0.04);
            if (root < 1e-9 * half * half) continue;
            const double t = (-half - std::sqrt(root)) / squared;
            EXPECT_GT(t, 1 - 1e-5) << "pixel " << i << " object " << o << ", seed 411";
            if (o + 1 == shown) {
                EXPECT_NEAR(t, 1, 1e-5) << "pixel " << i;
            }
        }
    }
    EXPECT_GT(seen, 5000u);
}

TEST_P(Instances, LanesDoNotChangeABit) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    std::vector<std::string> objects = turned_objects();
    const std::vector<std::string> whole = whole_voxel_objects();
    objects.insert(objects.end(), whole.begin(), whole.end());
    const Scene scene = instance_scene(GetParam(), "instance", objects);
    const Image own = image_of_scene(scene);
    const std::string surface = GetParam();
    const size_t turn = surface == "cubes" ? 0 : surface == "smooth" ? 1 : 2;
    for (const int lanes : in_turn<int>({1, 4, 8, 16}, turn)) {
        const Image other = image_of_scene(scene, test_device(lanes));
        EXPECT_EQ(other.id_planes, own.id_planes) << lanes;
        for (const auto& [name, plane] : own.planes)
            EXPECT_TRUE(other.planes.at(name) == plane) << name << " with " << lanes;
    }
}

TEST(Instance, MovedInstancesAreSeenWhereTheyAre) {
    Scene scene = instance_scene("cubes", "instance", whole_voxel_objects());
    WorldReport report;
    const Device device = test_device();
    Pyramid world = build_world(device, scene, report);
    EXPECT_EQ(report.instances.instances, 4u);
    EXPECT_EQ(report.instances.models, 2u);
    const std::vector<InstanceRecord> before = world.instances.records.read();
    scene.objects[2].world_from_object[3] += glm::dvec4(0.07, 0, -0.02, 0);
    move_instances(device, scene, world);
    const std::vector<InstanceRecord> after = world.instances.records.read();
    EXPECT_EQ(after[2].center[0] - before[2].center[0], 7);
    EXPECT_EQ(after[2].center[2] - before[2].center[2], -2);
    EXPECT_EQ(after[1].center[0], before[1].center[0]);
}

std::string refusal(Scene scene) {
    try {
        image_of_scene(scene);
    } catch (const Error& error) {
        EXPECT_EQ(error.kind(), ErrorKind::scene);
        return error.what();
    }
    return "rendered";
}

TEST(Instance, WhatNeedsTheWorldsVoxelsIsRefusedWhenItIsForcedAndElseStaysThere) {
    Scene scene = instance_scene("cubes", "instance", whole_voxel_objects());
    scene.materials[size_t(scene.objects[1].material)].opacity = 0.5f;
    EXPECT_THAT(refusal(scene),
                testing::HasSubstr("\"objects[1]\" can't be placed as an instance"));
    EXPECT_THAT(refusal(scene), testing::HasSubstr("lets light through"));
    scene.objects[1].placement = Placement::automatic;
    scene.objects[1].moves = true;
    EXPECT_FALSE(is_instanced(scene, scene.objects[1]));
    Scene smooth = scene;
    for (Model& model : smooth.models) model.surface = Surface::smooth;
    EXPECT_FALSE(is_instanced(smooth, smooth.objects[1]));
    EXPECT_TRUE(can_be_instance(smooth, smooth.objects[1]));
    scene.materials[size_t(scene.objects[1].material)].opacity = 1;
    EXPECT_TRUE(is_instanced(scene, scene.objects[1]));
    scene.objects[1].moves = false;
    EXPECT_FALSE(is_instanced(scene, scene.objects[1]));
}

}  // namespace
}  // namespace voxelume
