// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/emissive_pieces.hpp"

#include <gmock/gmock.h>

#include <cmath>
#include <numbers>

#include "runtime/stages/trace/trace.hpp"
#include "tests/light/area_light_scenes.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

using std::numbers::pi;

double area_of(const std::vector<EmissivePiece>& pieces) {
    double sum = 0;
    for (const EmissivePiece& piece : pieces) sum += piece.area;
    return sum;
}

/// The pieces of the scene's object 0, in a world whose first corner is (-0.5, -0.1, -0.4).
std::vector<EmissivePiece> pieces_of(const Scene& scene, int lanes = 0) {
    const Device device = test_device(lanes);
    WorldReport report;
    const Pyramid world = build_world(device, scene, report);
    std::vector<uint32_t> emissive_objects(scene.objects.size(), 0);
    emissive_objects[0] = 1;
    auto found = emissive_pieces(device, features_of(world), scene, world, emissive_objects);
    EXPECT_EQ(found.size(), 1u);
    return found[0];
}

Scene emissive_scene(const std::string& model, const std::string& more = "") {
    return floor_scene(
        "\"lamp\": " + model + ",",
        R"({"model": "lamp", "material": "glow", "position": [0.05, 0.4, 0.1])" + more + "},", "");
}

TEST(AreaInVoxel, OfPlanesByHand) {
    const glm::dvec3 edge(2, 3, 5), middle(0.5);
    EXPECT_NEAR(area_in_voxel(middle, {1, 0, 0}, edge), 15, 1e-12);
    EXPECT_NEAR(area_in_voxel(middle, {0, -7, 0}, edge), 10, 1e-12);
    // The plane runs across the diagonal of the xy side: sqrt(2² + 3²) long, 5 wide.
    EXPECT_NEAR(area_in_voxel(middle, {1, 1, 0}, edge), std::sqrt(13.0) * 5, 1e-12);
    // The plane cuts a corner: the triangle (1,0,0) (0,1,0) (0,0,1) of the unit cube.
    EXPECT_NEAR(area_in_voxel({1.0 / 3, 1.0 / 3, 1.0 / 3}, {1, 1, 1}, {1, 1, 1}),
                std::sqrt(3.0) / 2, 1e-12);
    EXPECT_NEAR(area_in_voxel({0.5, 1.2, 0.5}, {0, 1, 0}, edge), 0, 1e-12);
}

TEST(EmissivePieces, OfABallHaveItsAreaAndLieOnIt) {
    for (const char* surface : {"smooth", "exact"}) {
        const std::vector<EmissivePiece> pieces = pieces_of(emissive_scene(
            std::string(R"({"shape": "sphere", "radius": 0.15, "voxel_size": 0.01, "surface": ")") +
            surface + "\"}"));
        EXPECT_NEAR(area_of(pieces), 4 * pi * 0.15 * 0.15, 0.01 * 4 * pi * 0.15 * 0.15) << surface;
        for (const EmissivePiece& piece : pieces) {
            if (!piece.is_exact) continue;
            const glm::dvec3 from_middle = piece.position - glm::dvec3(0.55, 0.5, 0.5);
            ASSERT_NEAR(glm::length(from_middle), 0.15, 2e-4) << surface;
            ASSERT_GT(glm::dot(glm::normalize(from_middle), piece.normal), 0.9999) << surface;
        }
    }
}

TEST(EmissivePieces, OfABoxOfCubesAreItsOuterFaces) {
    // The box has 10 x 6 x 4 world voxels from voxel (22, 20, 18) on. Its middle lies at ((0.05 +
    // 0.5) / 0.02, ...) = (27.5, 28.9, 23.4), and it spans 5, 3 and 2 voxels to both sides.
    const std::vector<EmissivePiece> pieces = pieces_of(emissive_scene(
        R"({"shape": "box", "size": [0.2, 0.1038, 0.0856], "surface": "cubes", "set": "solid",
            "voxel_size": [0.02, 0.0173, 0.0214]})",
        R"(, "priority": 1)"));
    std::map<std::array<int, 3>, int> faces;
    glm::dvec3 sum(0);
    for (const EmissivePiece& piece : pieces) {
        ++faces[{int(piece.normal.x), int(piece.normal.y), int(piece.normal.z)}];
        sum += piece.normal * piece.area;
    }
    EXPECT_EQ(faces.size(), 6u);
    for (const auto& [normal, count] : faces)
        EXPECT_EQ(count, (faces[{-normal[0], -normal[1], -normal[2]}]));
    EXPECT_NEAR(glm::length(sum), 0, 1e-12);
    EXPECT_NEAR((faces[{1, 0, 0}]) * 0.0173 * 0.0214, 0.1038 * 0.0856, 0.35 * 0.1038 * 0.0856);
}

class MeshPieces : public FileTest {
  protected:
    Scene scene(const Mesh& mesh) {
        write_obj(folder / "lamp.obj", mesh);
        Scene s = emissive_scene(R"({"shape": "sphere", "radius": 0.1, "surface": "exact"})");
        s.models[0].solid.reset();
        s.models[0].mesh = folder / "lamp.obj";
        return s;
    }
};

TEST_F(MeshPieces, OfAClosedMeshFaceOutwardsWhicheverWayItIsWound) {
    for (const bool inside_out : {false, true}) {
        Mesh mesh = ball({0.01, 0.02, 0}, 0.12, 32, 16);
        double area = 0;
        for (glm::uvec3& t : mesh.triangles) {
            if (inside_out) std::swap(t.x, t.y);
            const glm::dvec3 a = mesh.positions[t.x], b = mesh.positions[t.y],
                             c = mesh.positions[t.z];
            area += glm::length(glm::cross(b - a, c - a)) / 2;
        }
        const std::vector<EmissivePiece> pieces = pieces_of(scene(mesh));
        EXPECT_NEAR(area_of(pieces), area, 1e-3 * area);
        for (const EmissivePiece& piece : pieces)
            ASSERT_GT(glm::dot(piece.position - glm::dvec3(0.56, 0.52, 0.5), piece.normal), 0);
    }
}

TEST_F(MeshPieces, OfAnOpenMeshFaceBothWays) {
    Mesh mesh;
    mesh.positions = {{-0.1f, 0, -0.1f}, {0.2f, 0.01f, 0}, {0, 0.05f, 0.2f}};
    mesh.triangles = {{0, 1, 2}};
    const std::vector<EmissivePiece> pieces = pieces_of(scene(mesh));
    const glm::dvec3 area =
        glm::cross(glm::dvec3(0.3, 0.01, 0.1), glm::dvec3(0.1, 0.05, 0.3)) / 2.0;
    EXPECT_NEAR(area_of(pieces), 2 * glm::length(area), 1e-3 * glm::length(area));
    EXPECT_GT(pieces.size(), 1000u) << "parts small enough for many light samples";
    glm::dvec3 sum(0);
    for (const EmissivePiece& piece : pieces) sum += piece.normal * piece.area;
    EXPECT_NEAR(glm::length(sum), 0, 1e-9);
}

TEST(EmissivePieces, AreTheSameWithAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    const Scene scene =
        emissive_scene(R"({"shape": "torus", "radius": 0.12, "tube": 0.05, "surface": "exact"})",
                       R"(, "turn": [10, 20, 30])");
    const std::vector<EmissivePiece> expected = pieces_of(scene, 1);
    for (const int lanes : in_turn<int>({4, 8, 16}, 1)) {
        const std::vector<EmissivePiece> pieces = pieces_of(scene, lanes);
        ASSERT_EQ(pieces.size(), expected.size());
        for (size_t i = 0; i < pieces.size(); ++i) {
            ASSERT_EQ(pieces[i].position, expected[i].position);
            ASSERT_EQ(pieces[i].normal, expected[i].normal);
        }
    }
}

}  // namespace
}  // namespace voxelume
