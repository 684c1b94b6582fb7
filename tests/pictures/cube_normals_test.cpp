// SPDX-License-Identifier: Apache-2.0
// Cubes with the normals of the surface that they stand for: the N plane against formulas and
// against closest points found in double, light without the shadows of steps, and what may not
// change.
#include <gtest/gtest.h>

#include <cmath>
#include <numbers>

#include "runtime/assets/model_frame.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/instance_scenes.hpp"
#include "tests/support/test_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

double degrees_apart(const glm::dvec3& a, const glm::dvec3& b) {
    return std::atan2(glm::length(glm::cross(a, b)), glm::dot(a, b)) * 180 / std::numbers::pi;
}

class SoftCubes : public FileTest {
  protected:
    Scene scene_of(const std::string& model, double edge, const std::string& object,
                   const std::string& normals = "surface", const std::string& more = "") const {
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": [{0}, {1}, {2}], "ambient": [0.1, 0.1, 0.1],
          "bounds": {{"min": [-1.5, -1.5, -1.5], "max": [1.5, 1.5, 1.5]}}}},
"materials": {{"default": {{"color": [1, 1, 1]}}}},
"models": {{"thing": {{{3}, "voxel_size": [{0}, {1}, {2}], "surface": "cubes", "normals": "{4}"}}}},
"objects": [{{"model": "thing", {5}}}],
"lights": [{{"type": "directional", "direction": [-1, 0, 0], "intensity": 1}}],
"observer": {{"position": [0.3, 0.4, -2.4], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [40, 30]}}}},
"render": {{"size": [120, 90]}} {6}}})",
                                       edge, 0.8 * edge, 1.2 * edge, model, normals, object, more),
                           folder / "scene.json", {});
    }
};

constexpr const char* kSoftBall = R"("shape": "sphere", "radius": 0.8)";
constexpr const char* kSoftRing = R"("shape": "torus", "radius": 0.6, "tube": 0.25)";

/// The gradient of the ball's or the ring's distance at a point of its space.
glm::dvec3 formula_gradient(const std::string& model, const glm::dvec3& p) {
    if (model == kSoftBall) return p;
    const double across = std::hypot(p.x, p.z), share = (across - 0.6) / across;
    return {p.x * share, p.y, p.z * share};
}

/// The root of the mean square of the angles between the N plane and the formula's normals at P.
double rms_of_normals(const Image& image, const std::string& model, const glm::dmat4& map) {
    const glm::dmat4 back = glm::inverse(map);
    double squares = 0;
    size_t pixels = 0;
    for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
        if (image.id_planes.at("objectId")[i] == 0) continue;
        const glm::dvec3 p(back * glm::dvec4(vector_at(image, "P", i), 1));
        const glm::dvec3 n = glm::transpose(glm::dmat3(back)) * formula_gradient(model, p);
        const double degrees = degrees_apart(vector_at(image, "N", i), n);
        squares += degrees * degrees;
        ++pixels;
    }
    EXPECT_GT(pixels, 1000u);
    return std::sqrt(squares / double(pixels));
}

TEST_F(SoftCubes, OfSolidsAreThoseOfTheFormulaTheBetterTheFinerTheVoxels) {
    for (const char* model : {kSoftBall, kSoftRing})
        for (const char* placement : {"world", "instance"})
            for (const char* map :
                 {R"("turn": [0, 0, 0])", R"("scale": [1.4, -0.7, 1], "turn": [0, 40, 20])",
                  R"("matrix": [[1, 0.4, 0, 0.1], [0, 1, -0.3, 0], [0.2, 0, 0.8, 0]])"}) {
                // P lies on a face, up to a voxel from the point that N belongs to; a voxel of the
                // world takes the normal of an object's voxel that is up to another away.
                const bool is_own = std::string(map) == R"("turn": [0, 0, 0])";
                const double bend = (model == kSoftBall ? 1 / 0.8 : 1 / 0.25) * (is_own ? 1 : 2);
                std::vector<double> found;
                for (const double edge : {0.08, 0.04, 0.02}) {
                    const Scene scene = scene_of(
                        model, edge, fmt::format(R"("placement": "{}", {})", placement, map));
                    found.push_back(rms_of_normals(image_of_scene(scene), model,
                                                   scene.objects[0].world_from_object));
                    EXPECT_LT(found.back(), 1.3 * edge * bend * 180 / std::numbers::pi)
                        << model << placement << map << edge;
                }
                EXPECT_LT(found[2], 0.62 * found[0]) << model << placement << map;
            }
}

/// The closest point of a triangle to p, by the shares of its corners (Ericson 2005, 5.1.5).
glm::dvec3 shares_of_closest(const std::array<glm::dvec3, 3>& t, const glm::dvec3& p) {
    const glm::dvec3 ab = t[1] - t[0], ac = t[2] - t[0], n = glm::cross(ab, ac);
    const double whole = glm::dot(n, n);
    const glm::dvec3 inside{glm::dot(glm::cross(t[2] - t[1], p - t[1]), n) / whole,
                            glm::dot(glm::cross(t[0] - t[2], p - t[2]), n) / whole,
                            glm::dot(glm::cross(ab, p - t[0]), n) / whole};
    if (glm::all(glm::greaterThanEqual(inside, glm::dvec3(0)))) return inside;
    glm::dvec3 best(0);
    double min = INFINITY;
    for (int i = 0; i < 3; ++i) {
        const glm::dvec3 edge = t[size_t((i + 1) % 3)] - t[size_t(i)];
        const double s =
            glm::clamp(glm::dot(p - t[size_t(i)], edge) / glm::dot(edge, edge), 0.0, 1.0);
        const double distance = glm::length(p - t[size_t(i)] - edge * s);
        if (distance >= min) continue;
        min = distance;
        best = glm::dvec3(0);
        best[i] = 1 - s;
        best[(i + 1) % 3] = s;
    }
    return best;
}

/// The normal of the point of a mesh that is closest to p, by its corners' normals or, `flat`, its
/// triangles'; nothing where other points are nearly as close.
std::optional<glm::dvec3> closest_normal(const Mesh& mesh, const glm::dvec3& p, bool flat) {
    double min = INFINITY, next = INFINITY;
    glm::dvec3 normal(0);
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        std::array<glm::dvec3, 3> corners, normals;
        for (size_t k = 0; k < 3; ++k) {
            const uint32_t vertex = mesh.triangles[i][int(k)];
            corners[k] = mesh.positions[vertex];
            normals[k] = glm::normalize(glm::dvec3(mesh.normals[vertex]));
        }
        const glm::dvec3 face = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        if (glm::length(face) < 1e-9) continue;
        const glm::dvec3 w = shares_of_closest(corners, p);
        const double distance =
            glm::length(corners[0] * w.x + corners[1] * w.y + corners[2] * w.z - p);
        const glm::dvec3 own = flat ? face : normals[0] * w.x + normals[1] * w.y + normals[2] * w.z;
        if (distance < min) {
            if (degrees_apart(own, normal) > 0.1 || normal == glm::dvec3(0)) next = min;
            min = distance, normal = own;
        } else if (degrees_apart(own, normal) > 0.1) {
            next = std::min(next, distance);
        }
    }
    if (next - min < 1e-3) return std::nullopt;
    return normal;
}

TEST_F(SoftCubes, OfMeshesAreThoseOfThePointClosestToTheVoxelsCentre) {
    Mesh mesh = ball({0.01, -0.02, 0.03}, 0.8, 20, 10);
    for (const glm::vec3& p : mesh.positions)
        mesh.normals.push_back(p + glm::vec3(0.2f * p.y, -0.1f, 0.15f * p.x));
    mesh.triangle_normals = mesh.triangles;
    write_obj(folder / "mesh.obj", mesh);
    constexpr double kEdge = 0.1;
    const glm::dvec3 edges = glm::dvec3(1, 0.8, 1.2) * kEdge;
    for (const bool flat : {false, true}) {
        const Scene scene =
            scene_of(fmt::format(R"("mesh": "mesh.obj", "shading": "{}")", flat ? "flat" : "auto"),
                     kEdge, R"("placement": "instance")");
        const Image image = image_of_scene(scene);
        const MeshSummary summary = summary_of(mesh);
        const glm::dvec3 origin = model_frame(scene.models[0], &summary).origin;
        size_t pixels = 0, compared = 0, wrong = 0;
        for (size_t i = 0; i < image.planes.at("Z").size(); i += 3) {
            if (image.id_planes.at("objectId")[i] == 0) continue;
            ++pixels;
            const glm::dvec3 p = vector_at(image, "P", i), way = p - scene.observer.position;
            const glm::dvec3 voxel = glm::floor((p + 1e-5 * way - origin) / edges);
            const auto expected = closest_normal(mesh, origin + (voxel + 0.5) * edges, flat);
            if (!expected) continue;
            ++compared;
            wrong += degrees_apart(vector_at(image, "N", i), *expected) > (flat ? 0.02 : 0.1);
        }
        EXPECT_LE(wrong, pixels / 500 + 1);  // P lies on the edge of two cubes
        EXPECT_GT(double(compared), 0.8 * double(pixels)) << pixels;
        EXPECT_GT(pixels, 700u);
    }
}

/// The light falls from the side: no step of the ball casts a shadow.
TEST_F(SoftCubes, LightFadesToTheTerminatorWithoutTheStepsShadows) {
    for (const char* placement : {"world", "instance"})
        for (const char* set : {"supercover", "solid"}) {
            const Image image = image_of_scene(
                scene_of(fmt::format(R"({}, "set": "{}")", kSoftBall, set), 0.07,
                         fmt::format(R"("placement": "{}", "turn": [20, 0, 0])", placement)));
            size_t lit = 0, dark = 0, shadowed = 0;
            for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
                if (image.id_planes.at("objectId")[i] == 0) continue;
                const double cosine = vector_at(image, "N", i).x;
                const double light = image.planes.at("R")[i] - 0.1;
                if (cosine > 0.05) {
                    ++lit;
                    shadowed += std::abs(light - cosine) > 1e-4;
                } else if (cosine < 0) {
                    EXPECT_NEAR(light, 0, 1e-6) << placement << i;
                    ++dark;
                }
            }
            EXPECT_GT(lit, 1000u);
            EXPECT_GT(dark, 1000u);
            EXPECT_LE(shadowed, lit / 100) << placement << set;
        }
}

/// A white ball in a world of voxels of 0.05 m. The ball's own voxels are `ratio` times as large.
std::string resampled_ball(double ratio, const char* set, const char* turn) {
    return fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1.5, -1.5, -1.5], "max": [1.5, 1.5, 1.5]}}}},
"materials": {{"default": {{"color": [1, 1, 1]}}}},
"models": {{"thing": {{{}, "set": "{}", "voxel_size": {}, "surface": "cubes",
                      "normals": "surface"}}}},
"objects": [{{"model": "thing", "turn": [{}], "placement": "world"}}],
"lights": [{{"type": "directional", "direction": [-1, 0, 0], "intensity": 1}}],
"observer": {{"position": [0.3, 0.4, -2.4], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [40, 30]}}}},
"render": {{"size": [160, 120]}}}})",
                       kSoftBall, set, 0.05 * ratio, turn);
}

/// The world takes voxels of the model whose steps lie askew to its own, and may be several of its
/// voxels high. Rays to lights once began as low as above steps of the world's voxels.
TEST_F(SoftCubes, CastNoShadowsOfTheirStepsWhereTheyAreResampled) {
    struct Case {
        double ratio;
        const char* turn;
    };
    for (const auto& [ratio, turn] : {Case{0.5, "30, 20, 10"},
                                      {1, "30, 20, 10"},
                                      {1, "-65, 40, 25"},
                                      {1.7, "10, 80, -50"},
                                      {2.3, "45, 35, 0"},
                                      {4, "30, 20, 10"}})
        for (const char* set : {"supercover", "thin", "solid"}) {
            const Image image = image_of_scene(
                parse_scene(resampled_ball(ratio, set, turn), folder / "scene.json", {}));
            size_t lit = 0, shadowed = 0;
            for (size_t i = 0; i < image.planes.at("Z").size(); ++i) {
                if (image.id_planes.at("objectId")[i] == 0) continue;
                const double cosine = vector_at(image, "N", i).x;
                if (cosine <= 0 || vector_at(image, "P", i).x <= 0) continue;
                ++lit;
                shadowed += std::abs(image.planes.at("R")[i] - cosine) > 1e-4;
            }
            EXPECT_GT(lit, 2000u);
            EXPECT_EQ(shadowed, 0u) << ratio << set << turn << " of " << lit;
        }
}

TEST_F(SoftCubes, ChangeNeitherWhatIsSeenNorWhere) {
    for (const char* placement : {"world", "instance"}) {
        const std::string object =
            fmt::format(R"("placement": "{}", "turn": [33, 11, 7])", placement);
        const Image soft = image_of_scene(scene_of(kSoftRing, 0.08, object));
        const Image hard = image_of_scene(scene_of(kSoftRing, 0.08, object, "faces"));
        for (const char* plane : {"P.X", "P.Y", "P.Z", "Z", "A"})
            EXPECT_EQ(soft.planes.at(plane), hard.planes.at(plane)) << plane;
        EXPECT_EQ(soft.id_planes, hard.id_planes);
        EXPECT_NE(soft.planes.at("N.X"), hard.planes.at("N.X"));
        EXPECT_NE(soft.planes.at("R"), hard.planes.at("R"));
    }
}

/// A world in which cubes with normals, cubes without, a field and instances share voxels.
TEST_F(SoftCubes, AreTheSameBitsInAnyNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    write_obj(folder / "mesh.obj", wavy_ring(24, 12));
    const Scene scene =
        scene_of(fmt::format(
                     R"({}}}, "hard": {{"shape": "box", "size": [2, 0.3, 2], "surface": "cubes"}},
"field": {{"shape": "sphere", "radius": 0.5, "surface": "smooth"}},
"cut": {{"mesh": "mesh.obj", "surface": "cubes", "voxel_size": 0.06, "normals": "surface",
         "cut": [{{"shape": "sphere", "radius": 0.5, "position": [0.4, 0, 0]}}]}},
"soft": {{"shape": "box", "size": [0.8, 0.8, 0.8])",
                     kSoftBall),
                 0.08, R"("turn": [33, 11, 7]},
{"model": "hard", "position": [0, -0.7, 0]}, {"model": "field", "position": [-0.5, 0.4, 0]},
{"model": "cut", "placement": "instance", "position": [0.6, 0.3, 0], "turn": [0, 50, 0]},
{"model": "cut", "placement": "world", "position": [-0.6, -0.3, 0], "turn": [0, 50, 0]},
{"model": "soft", "position": [0.5, -0.4, -0.4])");
    const Image wide = image_of_scene(scene, test_device(16));
    for (const int lanes : in_turn<int>({1, 4}, 1))
        EXPECT_EQ(image_of_scene(scene, test_device(lanes)).planes, wide.planes) << lanes;
}

}  // namespace
}  // namespace voxelume
