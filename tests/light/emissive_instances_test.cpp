// SPDX-License-Identifier: Apache-2.0
// The pieces of emissive objects that are instances, against formulas and against the same objects
// in the world.
#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "runtime/stages/light/emissive_pieces.hpp"
#include "tests/light/area_light_scenes.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

/// The pieces of the scene's objects, in a world whose first corner is (-0.5, -0.1, -0.4).
PiecesOfObjects all_pieces_of(const Scene& scene) {
    WorldReport report;
    const Pyramid world = build_world(shared_device(), scene, report);
    std::vector<uint32_t> is_emissive;
    for (const Object& object : scene.objects)
        is_emissive.push_back(scene.materials[size_t(object.material)].emission != glm::vec3(0));
    return emissive_pieces(shared_device(), features_of(world), scene, world, is_emissive);
}

struct PieceSums {
    double area = 0;
    glm::dvec3 middle{0}, area_vector{0};
    double volume = 0;  ///< by the divergence of the position
};

PieceSums sums_of(const std::vector<EmissivePiece>& pieces) {
    PieceSums sums;
    for (const EmissivePiece& piece : pieces) {
        sums.area += piece.area;
        sums.middle += piece.area * piece.position;
        sums.area_vector += piece.area * piece.normal;
        sums.volume += piece.area * glm::dot(piece.normal, piece.position) / 3;
    }
    sums.middle /= sums.area;
    return sums;
}

Scene placed_emissive(const std::string& model, const std::string& place) {
    return floor_scene(
        "\"lamp\": {" + model + "},",
        R"({"model": "lamp", "material": "glow", "placement": "instance", )" + place + "},", "");
}

/// A turn, a mirror and a shear at once: x' = 0.5 x + 0.2 y, y' = -0.4 z, z' = 0.7 y + 0.1 x.
constexpr const char* kMap =
    R"("matrix": [[0.5, 0.2, 0, 0.05], [0, 0, -0.4, 0.4], [0.1, 0.7, 0, 0.1]])";
const glm::dmat3 kLinear(0.5, 0, 0.1, 0.2, 0, 0.7, 0, -0.4, 0);

// The ball x'x = r² becomes an ellipsoid whose points and normals the inverse map tells.
TEST(EmissiveInstance, OfABallUnderAnyMapLiesOnTheEllipsoidAndFacesOutwards) {
    for (const char* surface : {"smooth", "exact"}) {
        const Scene scene = placed_emissive(
            std::string(R"("shape": "sphere", "radius": 0.3, "voxel_size": 0.02, "surface": ")") +
                surface + "\"",
            kMap);
        const PiecesOfObjects found = all_pieces_of(scene);
        ASSERT_EQ(found.size(), 1u);
        const glm::dvec3 middle(0.55, 0.5, 0.5);
        const glm::dmat3 inverse = glm::inverse(kLinear);
        for (const EmissivePiece& piece : found.at(0)) {
            if (!piece.is_exact) continue;
            const glm::dvec3 p_object = inverse * (piece.position - middle);
            ASSERT_NEAR(glm::length(p_object), 0.3, 4e-4) << surface;
            const glm::dvec3 normal = glm::normalize(glm::transpose(inverse) * p_object);
            ASSERT_GT(glm::dot(normal, piece.normal), 0.9999) << surface;
        }
        const PieceSums sums = sums_of(found.at(0));
        const double volume =
            4.0 / 3 * std::numbers::pi * std::pow(0.3, 3) * std::abs(glm::determinant(kLinear));
        EXPECT_NEAR(sums.volume, volume, 0.01 * volume) << surface;
        EXPECT_LT(glm::length(sums.area_vector), 1e-3 * sums.area) << surface;
        EXPECT_LT(glm::distance(sums.middle, middle), 1e-3) << surface;
    }
}

TEST(EmissiveInstance, OfCubesHasTheFacesThatItHasInTheWorld) {
    const auto box = [](const char* placement) {
        const Scene scene = floor_scene(
            R"("lamp": {"shape": "box", "size": [0.2, 0.1038, 0.0856], "surface": "cubes",
                        "set": "solid", "voxel_size": [0.02, 0.0173, 0.0214]},)",
            fmt::format(R"({{"model": "lamp", "material": "glow", "position": [0.05, 0.4, 0.1],
                             "placement": "{}"}},)",
                        placement),
            "");
        return sums_of(all_pieces_of(scene).at(0));
    };
    const PieceSums world = box("world"), instance = box("instance");
    EXPECT_NEAR(instance.area, world.area, 1e-9);
    EXPECT_LT(glm::distance(instance.middle, glm::dvec3(0.55, 0.5, 0.5)), 1e-9);
    EXPECT_LT(glm::length(instance.area_vector), 1e-9);
}

// Each model is searched twice, to count its pieces and to list them, for all of its instances.
TEST(EmissiveInstance, ThatShowsAModelLikeAnotherAddsNoSearch) {
    const auto searches = [](const std::string& objects) {
        const Scene scene = floor_scene(
            R"("lamp": {"shape": "box", "size": [0.1, 0.06, 0.04], "surface": "cubes",
                        "voxel_size": 0.02},)",
            objects, "");
        DeviceCounters& counters = shared_device().counters();
        const uint64_t before = counters.launches["list_emissive"];
        const PiecesOfObjects found = all_pieces_of(scene);
        for (const auto& [object, pieces] : found)
            EXPECT_EQ(pieces.size(), found.at(0).size()) << object;
        return counters.launches["list_emissive"] - before;
    };
    const std::string start = R"({"model": "lamp", "material": "glow", "placement": "instance",)";
    EXPECT_EQ(searches(start + R"("position": [0, 0.2, 0]},)"), 2u);
    EXPECT_EQ(searches(start + R"("position": [0, 0.2, 0]},)" + start +
                       R"("position": [0.2, 0.3, 0], "turn": [0, 20, 0]},)" + start +
                       R"("position": [-0.2, 0.3, 0.1]},)"),
              2u);
    EXPECT_EQ(searches(start + R"("position": [0, 0.2, 0]},)" + start +
                       R"("position": [0.2, 0.3, 0], "spots": 20},)"),
              4u);
}

class EmissiveInstanceOfAMesh : public FileTest {};

// Object 0 is emissive in the world, and the mesh of object 1, which isn't, stands behind it in
// the same tables.
TEST_F(EmissiveInstanceOfAMesh, IsTheMeshPlacedAndAddsNothingToOtherEmissiveObjects) {
    write_obj(folder / "ball.obj", ball({0, 0, 0}, 0.3, 48, 24));
    const auto scene_of = [&](const char* materials) {
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.02, "bounds": {{"min": [-0.5, -0.1, -0.4], "max": [0.7, 0.8, 0.6]}}}},
"materials": {{"glow": {{"emission": [3, 2, 1]}}, "dull": {{}}}},
"models": {{"m": {{"mesh": "ball.obj", "surface": "exact", "voxel_size": 0.02}}}},
"objects": [{{"model": "m", "material": "{}", "placement": "world", "scale": 0.3,
              "position": [0.3, 0.2, 0.1]}},
            {{"model": "m", "material": "{}", "placement": "instance", {}}}],
"observer": {{"position": [0, 0, -3], "display": {{"shape": "pyramid"}}}}}})",
                                       std::string(materials).substr(0, 4),
                                       std::string(materials).substr(5), kMap),
                           folder / "test.json", {});
    };
    const PiecesOfObjects both = all_pieces_of(scene_of("glow glow"));
    const PiecesOfObjects first = all_pieces_of(scene_of("glow dull"));
    ASSERT_EQ(both.size(), 2u);
    ASSERT_EQ(first.size(), 1u);
    const double ball = 4 * std::numbers::pi * 0.09 * 0.09;
    EXPECT_NEAR(sums_of(first.at(0)).area, ball, 0.03 * ball);
    EXPECT_EQ(sums_of(both.at(0)).area, sums_of(first.at(0)).area);
    const double volume =
        4.0 / 3 * std::numbers::pi * std::pow(0.3, 3) * std::abs(glm::determinant(kLinear));
    EXPECT_NEAR(sums_of(both.at(1)).volume, volume, 0.04 * volume);
    EXPECT_LT(glm::length(sums_of(both.at(1)).area_vector), 1e-6);
}

}  // namespace
}  // namespace voxelume
