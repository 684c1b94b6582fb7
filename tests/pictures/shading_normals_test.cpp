// SPDX-License-Identifier: Apache-2.0
// Exact meshes lit by the normals of their vertices: the N plane against an oracle in double, light
// at the terminator, and what may not change.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <random>

#include "runtime/geometry/mesh_normals.hpp"
#include "tests/oracles/mesh/mesh_shading.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

double degrees_between(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

/// A coarse ring whose corners have their own normals, up to 25 degrees off those of its faces.
Mesh ring_with_normals() {
    Mesh mesh = wavy_ring(24, 12);
    const std::vector<glm::vec3> round = corner_normals(mesh, {ShadingKind::smooth, 90});
    std::mt19937 random(5);
    std::uniform_real_distribution<float> off(-0.2f, 0.2f);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const auto first = uint32_t(mesh.normals.size());
        for (size_t k = 0; k < 3; ++k)
            mesh.normals.push_back(round[3 * i + k] +
                                   glm::vec3(off(random), off(random), off(random)));
        mesh.triangle_normals.emplace_back(first, first + 1, first + 2);
    }
    return mesh;
}

class ShadingNormals : public FileTest {
  protected:
    Scene scene_of(const std::string& model, const std::string& objects,
                   const std::string& more = "") const {
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": [0.05, 0.04, 0.06], "ambient": [0.1, 0.1, 0.1],
          "bounds": {{"min": [-1.5, -1.5, -1.5], "max": [1.5, 1.5, 1.5]}}}},
"materials": {{"default": {{"color": [1, 1, 1]}}, "mirror": {{"diffuse": 0.1, "reflection": 0.9}},
              "glass": {{"diffuse": 0.1, "refraction": 0.9, "ior": 1.4}}}},
"models": {{"mesh": {{"mesh": "mesh.obj", "surface": "exact", "voxel_size": 0.05 {}}}}},
"objects": [{}],
"lights": [{{"type": "directional", "direction": [-1, 0, 0], "intensity": 1}}],
"observer": {{"position": [0.3, 0.4, -2.4], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [40, 30]}}}},
"render": {{"size": [160, 120]}} {}}})",
                                       model, objects, more),
                           folder / "scene.json", {});
    }
};

/// The largest angle between the N plane and the oracle's normals, and how many pixels it is of.
struct Compared {
    double largest = 0, squares = 0;
    size_t pixels = 0;
};

Compared compare(const Image& image, const Scene& scene, const Mesh& mesh) {
    const glm::dmat4& map = scene.objects[0].world_from_object;
    std::vector<oracle::ShadedTriangle> triangles;
    for (size_t t = 0; t < mesh.triangles.size(); ++t) {
        oracle::ShadedTriangle triangle;
        for (size_t i = 0; i < 3; ++i) {
            triangle.corners[i] = mesh.positions[mesh.triangles[t][int(i)]];
            triangle.normals[i] = mesh.normals[mesh.triangle_normals[t][int(i)]];
        }
        triangles.push_back(oracle::mapped(triangle, map));
    }
    Compared compared;
    const glm::dvec3 eye = scene.observer.position;
    for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
        if (image.id_planes.at("objectId")[i] == 0) continue;
        const glm::dvec3 way = vector_at(image, "P", i) - eye;
        const auto hit = oracle::shaded_hit(triangles, eye, way);
        if (!hit || std::abs(hit->t - 1) > 1e-4) continue;  // an edge between two triangles
        const double degrees = degrees_between(vector_at(image, "N", i), hit->normal);
        compared.largest = std::max(compared.largest, degrees);
        compared.squares += degrees * degrees;
        ++compared.pixels;
    }
    return compared;
}

TEST_F(ShadingNormals, AreTheOraclesUnderAnyMapInTheWorldAndAsInstances) {
    const Mesh mesh = ring_with_normals();
    write_obj(folder / "mesh.obj", mesh);
    for (const char* placement : {"world", "instance"})
        for (const char* map :
             {R"("position": [0, 0, 0])", R"("position": [0.1, 0, 0.05], "turn": [33, 11, 7])",
              R"("turn": [20, 50, 10], "scale": [-1, 1, 1])",
              R"("scale": [1.5, -0.7, 1], "turn": [0, 40, 20])",
              R"("matrix": [[1, 0.4, 0, 0.1], [0, 1, -0.3, 0], [0.2, 0, 0.8, 0]])"}) {
            const Scene scene = scene_of(
                "", fmt::format(R"({{"model": "mesh", "placement": "{}", {}}})", placement, map));
            const Compared compared = compare(image_of_scene(scene), scene, mesh);
            EXPECT_GT(compared.pixels, 2000u) << placement << map;
            EXPECT_LT(std::sqrt(compared.squares / double(compared.pixels)), 0.01)
                << placement << map;
            EXPECT_LT(compared.largest, 0.1) << placement << map;
        }
}

TEST_F(ShadingNormals, OfABallAreThoseOfTheSphere) {
    Mesh mesh = ball({0, 0, 0}, 0.8, 48, 24);
    mesh.normals = mesh.positions;
    mesh.triangle_normals = mesh.triangles;
    for (const bool has_normals : {true, false}) {
        if (!has_normals) mesh.normals.clear(), mesh.triangle_normals.clear();
        write_obj(folder / "mesh.obj", mesh);
        const std::string model = has_normals ? "" : R"(, "shading": "smooth")";
        const Image image = image_of_scene(scene_of(model, R"({"model": "mesh"})"));
        double squares = 0;
        size_t pixels = 0;
        for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
            if (image.id_planes.at("objectId")[i] == 0) continue;
            const double degrees =
                degrees_between(vector_at(image, "N", i), vector_at(image, "P", i));
            squares += degrees * degrees;
            ++pixels;
        }
        EXPECT_LT(std::sqrt(squares / double(pixels)), has_normals ? 0.1 : 0.2);
        EXPECT_GT(pixels, 3000u);
    }
}

/// The light falls from the side. A ball of few faces has many that look away from the light and
/// have corners whose normals don't.
TEST_F(ShadingNormals, LightFadesToTheTerminatorWithoutTheFacesShadows) {
    Mesh mesh = ball({0, 0, 0}, 0.8, 16, 8);
    mesh.normals = mesh.positions;
    mesh.triangle_normals = mesh.triangles;
    write_obj(folder / "mesh.obj", mesh);
    for (const char* placement : {"world", "instance"}) {
        const Image image = image_of_scene(
            scene_of("", fmt::format(R"({{"model": "mesh", "placement": "{}"}})", placement)));
        size_t lit = 0, dark = 0;
        for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
            if (image.id_planes.at("objectId")[i] == 0) continue;
            const double cosine = vector_at(image, "N", i).x;
            const double light = image.planes.at("R")[i] - 0.1;
            if (cosine > 0.02) {
                EXPECT_NEAR(light, cosine, 1e-4) << placement << i;
                ++lit;
            } else if (cosine < 0) {
                EXPECT_NEAR(light, 0, 1e-6) << placement << i;
                ++dark;
            }
        }
        EXPECT_GT(lit, 1000u);
        EXPECT_GT(dark, 1000u);
    }
}

TEST_F(ShadingNormals, ChangeNeitherWhatIsSeenNorWhere) {
    write_obj(folder / "mesh.obj", ring_with_normals());
    const std::string object = R"({"model": "mesh", "turn": [33, 11, 7]})";
    const Image smooth = image_of_scene(scene_of("", object));
    const Image flat = image_of_scene(scene_of(R"(, "shading": "flat")", object));
    for (const char* plane : {"P.X", "P.Y", "P.Z", "Z", "A"})
        EXPECT_EQ(smooth.planes.at(plane), flat.planes.at(plane)) << plane;
    EXPECT_EQ(smooth.id_planes, flat.id_planes);
    EXPECT_NE(smooth.planes.at("N.X"), flat.planes.at("N.X"));
    EXPECT_NE(smooth.planes.at("R"), flat.planes.at("R"));
}

/// Triangles without normals in a world that has some are as in a world that has none.
TEST_F(ShadingNormals, OfOneObjectChangeNoBitOfAnother) {
    write_obj(folder / "mesh.obj", wavy_ring(24, 12));
    Mesh far_away = ball({0, 0, 0}, 0.05, 6, 4);
    far_away.normals = far_away.positions;
    far_away.triangle_normals = far_away.triangles;
    write_obj(folder / "far.obj", far_away);
    for (const char* material : {"default", "mirror", "glass"})
        for (const char* placement : {"world", "instance"}) {
            if (std::string(material) == "glass" && std::string(placement) == "instance") continue;
            const bool is_plain = std::string(material) == "default";
            // By default, plain objects are instances and the others lie in the world.
            if (!is_exhaustive() && is_plain != (std::string(placement) == "instance")) continue;
            const auto image = [&](const char* shading) {
                Scene scene = scene_of(
                    fmt::format(
                        R"(}}, "far": {{"mesh": "far.obj", "surface": "exact", "shading": "{}")",
                        shading),
                    fmt::format(R"({{"model": "mesh", "material": "{0}", "placement": "{1}"}},
                                   {{"model": "far", "position": [-1.4, -1.4, 1.4], "placement": "{1}"}})",
                                material, placement));
                return image_of_scene(scene);
            };
            const Image with = image("auto"), without = image("flat");
            for (const char* plane : {"R", "G", "B", "N.X", "N.Y", "N.Z"}) {
                size_t different = 0;
                for (size_t i = 0; i < with.planes.at(plane).size(); ++i)
                    if (with.id_planes.at("objectId")[i] == 1)
                        different += with.planes.at(plane)[i] != without.planes.at(plane)[i];
                EXPECT_EQ(different, 0u) << material << placement << plane;
            }
        }
}

/// No light gets lost or comes in where reflected rays would run into the surface: in a white
/// furnace a mirror shows white everywhere.
TEST_F(ShadingNormals, MirrorsShowNothingFromBehindTheirSurface) {
    Mesh mesh = ball({0, 0, 0}, 0.8, 12, 6);
    mesh.normals = mesh.positions;
    mesh.triangle_normals = mesh.triangles;
    write_obj(folder / "mesh.obj", mesh);
    Scene scene = scene_of("", R"({"model": "mesh", "material": "mirror"})");
    scene.world.background = {1, 1, 1};
    scene.world.ambient = {0, 0, 0};
    scene.lights.clear();
    const Image image = image_of_scene(scene);
    for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
        if (image.id_planes.at("objectId")[i] == 0) continue;
        EXPECT_NEAR(image.planes.at("R")[i], 0.9, 1e-6) << i;
    }
}

}  // namespace
}  // namespace voxelume
