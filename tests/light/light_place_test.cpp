// SPDX-License-Identifier: Apache-2.0
// Point lights at awkward places: near the terminator, on planes of the lattice, inside voxels.
// Cases O9 and O10.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

using Json = nlohmann::json;

constexpr double kVoxel = 0.02, kRadius = 0.3;
const glm::dvec3 kCenter(0.013, 0.327, -0.021);

enum Part : uint32_t { kNothing = 0, kFloor = 1, kBall = 2 };

/// A white ball above a floor whose top is y = 0, a plane of the lattice, and one point light.
Json light_scene(const std::string& surface, const glm::dvec3& light) {
    Json scene = Json::parse(R"({"voxelume": 1,
"world": {"voxel_size": 0.02, "bounds": {"min": [-0.8, -0.2, -0.7], "max": [0.8, 0.9, 0.7]}},
"materials": {"white": {"color": [1, 1, 1]}},
"models": {"floor": {"shape": "box", "size": [1.2, 0.1, 1], "surface": "smooth"}, "ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"}},
"objects": [{"model": "floor", "material": "white", "position": [0, -0.05, 0]},
            {"model": "ball", "material": "white", "position": [0.013, 0.327, -0.021]}],
"lights": [{"type": "point"}],
"observer": {"position": [0.4, 1.6, 2.4], "look_at": [0, 0.2, 0], "display": {"shape": "pyramid", "angle": 34}},
"render": {"size": [160, 120]}})");
    for (const char* model : {"floor", "ball"}) scene["models"][model]["surface"] = surface;
    scene["lights"][0]["position"] = {light.x, light.y, light.z};
    return scene;
}

struct Pixel {
    Part part;
    glm::dvec3 position;
    double red;
};

std::vector<Pixel> pixels_of(const Json& text) {
    RenderReport report;
    const Image image = render(test_device(), parse_scene(text.dump(), "light scene", {}), report);
    EXPECT_EQ(report.not_finite, 0u);
    std::vector<Pixel> pixels;
    for (size_t i = 0; i < image.planes.at("R").size(); ++i)
        pixels.push_back(
            {Part(image.id_planes.at("objectId")[i]),
             {image.planes.at("P.X")[i], image.planes.at("P.Y")[i], image.planes.at("P.Z")[i]},
             image.planes.at("R")[i]});
    return pixels;
}

class PointLights : public testing::TestWithParam<const char*> {
  protected:
    bool is_exact() const { return std::string(GetParam()) == "exact"; }
};
INSTANTIATE_TEST_SUITE_P(Surfaces, PointLights, testing::Values("exact", "smooth"));

TEST_P(PointLights, O9ABallIsLitUpToItsTerminatorAndDarkBeyond) {
    const double band = is_exact() ? 1e-5 : 1e-3;   // of cosines between lit and dark
    const double bound = is_exact() ? 2e-6 : 7e-4;  // 1 / (6 R²), R = 15 voxels
    for (const glm::dvec3& light :
         {glm::dvec3(-0.7, 0.85, -0.6), glm::dvec3(30, 4, -20), glm::dvec3(-0.29, 0.5, 0)}) {
        Json scene = light_scene(GetParam(), light);
        scene["objects"].erase(0);
        size_t lit = 0, dark = 0, between = 0;
        for (const Pixel& pixel : pixels_of(scene)) {
            if (pixel.part == kNothing) continue;
            const glm::dvec3 n = glm::normalize(pixel.position - kCenter);
            const glm::dvec3 l = light - pixel.position;
            const double cosine = glm::dot(n, glm::normalize(l));
            if (cosine < -band) {
                ++dark;
                ASSERT_EQ(pixel.red, 0) << "cosine " << cosine;
            } else if (cosine > band) {
                ++lit;
                const double brightest = 1 / glm::dot(l, l);
                ASSERT_NEAR(pixel.red, cosine * brightest, bound * brightest)
                    << "cosine " << cosine;
            } else {
                ++between;
            }
        }
        EXPECT_GT(lit, 100u);
        EXPECT_GT(dark, 200u);
        EXPECT_LT(between, 50u);
    }
}

/// Compares the floor's pixels that are clear of the ball's shadow by one voxel with 1/d^2 and the
/// cosine.
void expect_floor_light(const Json& scene, const glm::dvec3& light, double bound) {
    size_t compared = 0;
    for (const Pixel& pixel : pixels_of(scene)) {
        if (pixel.part != kFloor || pixel.position.y < -1e-3) continue;
        const glm::dvec3 l = light - pixel.position;
        const double distance = glm::length(l);
        const glm::dvec3 to_center = kCenter - pixel.position;
        const double along = glm::dot(to_center, l) / distance;
        const double past = glm::length(glm::cross(to_center, l)) / distance;
        if (along > 0 && past < kRadius + kVoxel) continue;
        // Near its edges, within some voxels, a smooth floor is round.
        if (std::abs(pixel.position.x) > 0.5 || std::abs(pixel.position.z) > 0.4) continue;
        ++compared;
        const double brightest = 1 / (distance * distance);
        ASSERT_NEAR(pixel.red, light.y / distance * brightest,
                    brightest * (bound + 2e-7 / distance))
            << "at " << pixel.position.x << ' ' << pixel.position.z;
    }
    EXPECT_GT(compared, 1000u);
}

TEST_P(PointLights, O10ALightOnAPlaneOfTheLatticeOrInAVoxelOfASurfaceShinesAsElsewhere) {
    for (const glm::dvec3& light : {
             glm::dvec3(-0.4, 0.5, 0.3),        // on a corner of the lattice
             glm::dvec3(-0.4, 0.513, 0.207),    // on one of its planes
             glm::dvec3(-0.407, 0.013, 0.293),  // in a voxel above the floor
             glm::dvec3(-0.407, 0.004, 0.293),  // in a voxel that the floor touches
             glm::dvec3(-0.4, 0.02, 0.3),       // on the next plane above the floor
         })
        expect_floor_light(light_scene(GetParam(), light), light, is_exact() ? 3e-6 : 2e-3);
}

TEST_P(PointLights, O10ALightOnBelowOrInsideASurfaceDoesNotLightIt) {
    for (const glm::dvec3& light : {
             glm::dvec3(-0.4, -0.004, 0.3),  // in the floor's topmost voxels
             glm::dvec3(-0.413, -0.05, 0.307),
             glm::dvec3(0.013, 0.327, -0.021),  // in the ball's middle
             glm::dvec3(0.1, 0.4, 0.1),         // in the ball, on the lattice
         }) {
        size_t met = 0;
        for (const Pixel& pixel : pixels_of(light_scene(GetParam(), light))) {
            met += pixel.part != kNothing;
            ASSERT_EQ(pixel.red, 0)
                << "light at " << light.x << ' ' << light.y << ' ' << light.z << ", pixel at "
                << pixel.position.x << ' ' << pixel.position.y << ' ' << pixel.position.z;
        }
        EXPECT_GT(met, 2000u);
    }
}

}  // namespace
}  // namespace voxelume
