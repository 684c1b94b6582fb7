// SPDX-License-Identifier: Apache-2.0
// The choices that scenes leave to the sizes and numbers of their objects: `"placement": "auto"`,
// and the voxels of instances.
#include "runtime/scene/predicates.hpp"
#include "tests/analysis/chosen_scene.hpp"

namespace voxelume {
namespace {

using PlacementChoices = ChosenScene;

/// True if `auto` makes the first object an instance.
bool placed_as_instance(Scene scene) {
    AssetStore meshes;
    make_choices(scene, meshes);
    return is_instanced(scene, scene.objects[0]);
}

/// True if `auto` makes the first of `count` objects of the model an instance.
bool first_is_instanced(Scene scene, int count, const Material& material, bool has_cubes) {
    scene.materials.push_back(material);
    scene.objects[0].material = int(scene.materials.size()) - 1;
    scene.objects.resize(size_t(count), scene.objects[0]);
    if (has_cubes) {
        scene.models.push_back(scene.models[0]);
        scene.models.back().surface = Surface::cubes;
        scene.objects.push_back(scene.objects[0]);
        scene.objects.back().model = int(scene.models.size()) - 1;
    }
    return placed_as_instance(std::move(scene));
}

TEST_F(PlacementChoices, GiveLargeInstancesVoxelsAsLargeAsTheWorldsWhereTheyStand) {
    const auto edge = [&](const std::string& model, const std::string& keys) {
        const char* const surface =
            model.find("surface") == model.npos ? R"(, "surface": "smooth")" : "";
        return chosen(R"("shape": "sphere", "radius": )" + model + surface, keys).voxel_size;
    };
    const std::string placed = R"(, "placement": "instance", "scale": )";
    EXPECT_EQ(edge("0.3", placed + "1"), glm::dvec3(0.02));
    EXPECT_EQ(edge("0.3", placed + "0.5"), glm::dvec3(0.02));
    EXPECT_EQ(edge("0.1", placed + "4"), glm::dvec3(0.005));
    const glm::dvec3 between = edge("0.1", placed + "3.9");  // a step of a quarter octave above
    EXPECT_LE(between.x, 0.02 / 3.9);
    EXPECT_GE(between.x, 0.02 / 3.9 / std::exp2(0.25));
    EXPECT_EQ(edge("0.1", placed + "[1, 4, 2]"), glm::dvec3(0.02, 0.005, 0.01));
    EXPECT_EQ(edge("0.1", R"(, "scale": 4)"), glm::dvec3(0.02)) << "in the world";
    EXPECT_EQ(edge(R"(0.1, "voxel_size": 0.01)", placed + "4"), glm::dvec3(0.01));
    EXPECT_EQ(edge(R"(0.1, "surface": "cubes")", placed + "4"), glm::dvec3(0.02)) << "a style";
    EXPECT_EQ(edge("0.1", placed + R"(4, "visible": false)"), glm::dvec3(0.02)) << "hidden";
    EXPECT_NEAR(edge("0.3", placed + "50").x, 0.6 / 60, 1e-12) << "as many voxels as the world";
    const std::string box = R"("mesh": "box.obj", "surface": "exact")";
    EXPECT_NEAR(chosen(box, placed + "2").voxel_size.y, 0.01, 1e-8);
    // Its sides are 0.6, 0.45 and 0.3 m, and the world's longest side has 60 voxels.
    const glm::dvec3 large = chosen(box, placed + "50").voxel_size;
    EXPECT_NEAR(large.x, 0.01, 1e-8);
    EXPECT_NEAR(large.y, 0.0075, 1e-8);
    EXPECT_NEAR(large.z, 0.005, 1e-8);
}

TEST_F(PlacementChoices, GiveWhatGrowsVoxelsForItsLargestFrame) {
    const std::string ball = R"("shape": "sphere", "radius": 0.05, "surface": "smooth")";
    const std::string grows = R"({"target": "objects[0].scale", "keys": [
        {"frame": 1, "value": 0.5}, {"frame": 4, "value": 4}]})";
    EXPECT_EQ(chosen(ball, "", grows).voxel_size, glm::dvec3(0.005));
}

TEST_F(PlacementChoices, ManyCopiesOfAnExactMeshAreInstances) {
    const std::string box = R"("mesh": "box.obj", "surface": "exact")";
    Material glass, emissive;
    glass.opacity = 0.5f;
    emissive.emission = glm::vec3(1);
    EXPECT_TRUE(first_is_instanced(scene_of(box), 8, {}, false));
    EXPECT_FALSE(first_is_instanced(scene_of(box), 7, {}, false));
    EXPECT_FALSE(first_is_instanced(scene_of(box), 8, glass, false));
    EXPECT_FALSE(first_is_instanced(scene_of(box), 8, emissive, false));
    EXPECT_FALSE(first_is_instanced(scene_of(box), 8, {}, true));
    EXPECT_FALSE(
        first_is_instanced(scene_of(R"("mesh": "ring.obj", "surface": "smooth")"), 8, {}, false));
    EXPECT_FALSE(first_is_instanced(scene_of(box, R"(, "placement": "world")"), 8, {}, false));
}

/// In the world, each ray tests all triangles of the voxels that it comes through.
TEST_F(PlacementChoices, AnExactMeshOfManyTrianglesInAVoxelIsAnInstanceOfFinerVoxels) {
    write_obj(folder / "ball.obj", ball({0, 0, 0}, 0.05, 160, 80));
    const auto exact = [](const char* keys = "") {
        return fmt::format(R"("mesh": "ball.obj", "surface": "exact"{})", keys);
    };
    EXPECT_TRUE(first_is_instanced(scene_of(exact()), 1, {}, false));
    EXPECT_LT(chosen(exact()).voxel_size.x, 0.002);
    EXPECT_FALSE(first_is_instanced(scene_of(exact(), R"(, "scale": 10)"), 1, {}, false));
    EXPECT_EQ(chosen(exact(), R"(, "scale": 10)").voxel_size.x, 0.02);
    Material glass;
    glass.opacity = 0.5f;
    EXPECT_FALSE(first_is_instanced(scene_of(exact()), 1, glass, false));
    EXPECT_FALSE(first_is_instanced(scene_of(exact()), 1, {}, true)) << "beside cubes";
    const char* const outside = R"(, "position": [0.58, 0, 0])";
    EXPECT_FALSE(first_is_instanced(scene_of(exact(), outside), 1, {}, false));
    EXPECT_FALSE(first_is_instanced(scene_of(exact(R"(, "voxel_size": 0.02)")), 1, {}, false));
    EXPECT_LT(
        chosen(exact(), R"(, "placement": "instance", "position": [0.58, 0, 0])").voxel_size.x,
        0.002);
    Scene flush = scene_of(exact());
    flush.objects.push_back(flush.objects[0]);
    flush.objects[1].world_from_object[3] = glm::dvec4(0.02, 0, 0, 1);
    EXPECT_FALSE(placed_as_instance(flush));
    flush.objects[1].world_from_object[3] = glm::dvec4(0.02, 0.02, 0.02, 1);
    EXPECT_TRUE(placed_as_instance(flush));
}

TEST_F(PlacementChoices, MeshesThatChangeStayInTheWorldAndThoseOfSliversDoNot) {
    write_obj(folder / "slivers.obj", ball({0, 0, 0}, 0.05, 8000, 3));
    const std::string slivers = R"("mesh": "slivers.obj", "surface": "exact")";
    EXPECT_TRUE(placed_as_instance(scene_of(slivers)));
    for (int frame = 1; frame <= 4; ++frame)
        write_obj(folder / fmt::format("s.{}.obj", frame),
                  ball({0, 0, 0}, 0.01f * float(frame), 160, 80));
    const std::string grows =
        R"("mesh": "s.#.obj", "surface": "exact", "sequence": {"first": 1, "last": 4})";
    EXPECT_FALSE(placed_as_instance(scene_of(grows)));
    EXPECT_EQ(chosen(grows, R"(, "placement": "instance")").voxel_size, glm::dvec3(0.02));
}

}  // namespace
}  // namespace voxelume
