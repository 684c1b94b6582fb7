// SPDX-License-Identifier: Apache-2.0
// Instances inside cubes and exact objects that light goes through. Rays that continue from a face
// of these objects meet instances' surfaces that lie in the plane of that face.
#include <fmt/format.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

constexpr double kVoxel = 0.25;  // a power of two, so whole voxels are exact in all formats
constexpr double kOpacity = 0.125;
constexpr std::array<double, 3> kGlass = {0.25, 0.5, 0.75}, kBody = {0.9, 0.3, 0.1};
constexpr std::array<double, 3> kBackground = {0.2, 0.3, 0.5};
constexpr const char* kColors[] = {"R", "G", "B"};

/// A body of 4 x 6 x 8 voxels at `position`, as `surface` and `placement` say.
struct Body {
    std::string model = "solid", placement = "instance";
    std::array<int, 3> position{};  // voxels from the middle
    std::array<int, 3> quarters{};  // quarter turns about each axis
};

class InstanceInGlass : public FileTest {
  protected:
    /// A scene with a block of 20 x 18 x 22 clear cubes around bodies, in the middle of a world of
    /// 32 x 28 x 36. Bodies outside the world make all scenes use the same programs.
    Scene scene(const std::vector<Body>& bodies, const std::string& observer,
                const std::string& more_objects = "", const std::string& glass = "block") {
        write_obj(folder / "body.obj", box({-0.5, -0.75, -1}, {0.5, 0.75, 1}));
        std::string objects;
        for (const Body& body : bodies) {
            const auto& [x, y, z] = body.position;
            objects += fmt::format(
                R"({{"model": "{}", "material": "body", "placement": "{}", "position": [{}, {}, {}], "turn": [{}, {}, {}]}}, )",
                body.model, body.placement, x * kVoxel, y * kVoxel, z * kVoxel,
                90 * body.quarters[0], 90 * body.quarters[1], 90 * body.quarters[2]);
        }
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.25, "bounds": {{"min": [-4, -3.5, -4.5], "max": [4, 3.5, 4.5]}},
          "background": [0.2, 0.3, 0.5], "ambient": [1, 1, 1]}},
"materials": {{"glass": {{"color": [0.25, 0.5, 0.75], "opacity": 0.125}}, "clear": {{"opacity": 0}},
              "body": {{"color": [0.9, 0.3, 0.1]}}}},
"models": {{"block": {{"shape": "box", "size": [5, 4.5, 5.5], "surface": "cubes", "set": "solid"}},
           "cubes": {{"shape": "box", "size": [1, 1.5, 2], "surface": "cubes", "set": "solid"}},
           "solid": {{"shape": "box", "size": [1, 1.5, 2], "surface": "exact"}},
           "mesh": {{"mesh": "body.obj", "surface": "exact"}},
           "ball": {{"shape": "sphere", "radius": 1, "surface": "smooth"}},
           "glass ball": {{"shape": "sphere", "radius": 2, "surface": "smooth"}}}},
"objects": [{{"model": "{}", "material": "glass"}}, {}{}
            {{"model": "cubes", "placement": "instance", "position": [0, 40, 0]}},
            {{"model": "solid", "placement": "instance", "position": [0, 40, 0]}},
            {{"model": "mesh", "placement": "instance", "position": [0, 40, 0]}}],
"lights": [], "observer": {{{}}},
"render": {{"size": [72, 60], "least_weight": 0}}}})",
                                       glass, more_objects, objects, observer),
                           (folder / "test.json").string(), {});
    }

    static Image rendered(const Scene& scene) {
        RenderReport report;
        Image image = render(shared_device(), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        return image;
    }
};

/// A view along or against an axis, by parallel rays through the middles of voxels.
std::string along_axis(int axis, int sign) {
    std::array<double, 3> from{}, up{};
    from[size_t(axis)] = -20 * sign;
    up[size_t(axis == 1 ? 2 : 1)] = 1;
    return fmt::format(
        R"("position": [{}, {}, {}], "look_at": [0, 0, 0], "up": [{}, {}, {}], "display": {{"shape": "box", "size": [9, 7.5, 40]}})",
        from[0], from[1], from[2], up[0], up[1], up[2]);
}

/// The light of `color` seen through `layers` of glass.
double behind(int layers, double color, double glass) {
    const double left = std::pow(1 - kOpacity, layers);
    return left * color + (1 - left) * glass;
}

TEST_F(InstanceInGlass, AFaceInALatticePlaneIsSeenThroughAllVoxelsBeforeIt) {
    const std::array<int, 3> block = {20, 18, 22}, body = {4, 6, 8};
    size_t turn = 0;
    for (const char* model : {"solid", "mesh", "cubes"})
        for (int axis = 0; axis < 3; ++axis)
            for (const int sign : in_turn<int>({1, -1}, turn++)) {
                const size_t a = size_t(axis);
                const Image image = rendered(scene({{.model = model}}, along_axis(axis, sign)));
                // The block's voxel behind the face also begins in its plane, and the world's
                // voxels come first.
                const int before = (block[a] - body[a]) / 2 + 1;
                size_t seen = 0, through = 0, outside = 0;
                for (size_t i = 0; i < image.planes.at("R").size(); ++i) {
                    const auto shows = [&](const std::array<double, 3>& expected) {
                        bool same = true;
                        for (size_t c = 0; c < 3; ++c)
                            same &= std::abs(image.planes.at(kColors[c])[i] - expected[c]) < 2e-6;
                        return same;
                    };
                    const auto light = [&](int layers, const std::array<double, 3>& color) {
                        std::array<double, 3> sum{};
                        for (size_t c = 0; c < 3; ++c) sum[c] = behind(layers, color[c], kGlass[c]);
                        return sum;
                    };
                    seen += shows(light(before, kBody));
                    through += shows(light(block[a], kBackground));
                    outside += shows(kBackground);
                }
                const size_t pixels = image.planes.at("R").size();
                EXPECT_EQ(seen + through + outside, pixels)
                    << model << " along " << axis << " by " << sign;
                // Pixels are half a voxel wide.
                const auto area = [&](const std::array<int, 3>& size) {
                    return size_t(4) * size_t(size[(a + 1) % 3]) * size_t(size[(a + 2) % 3]);
                };
                EXPECT_EQ(seen, area(body)) << model << " along " << axis << " by " << sign;
                EXPECT_EQ(seen + through, area(block)) << model;
            }
}

/// Rays inside the world's smooth body are outside an instance's body.
TEST_F(InstanceInGlass, ASmoothBodyInSmoothGlassIsMetFromOutside) {
    const Image image = rendered(scene({{.model = "ball"}}, along_axis(2, 1), "", "glass ball"));
    size_t seen = 0;
    for (const float red : image.planes.at("R"))
        seen += std::abs(red - behind(1, kBody[0], kGlass[0])) < 2e-6;
    const double area = std::numbers::pi * 8 * 8;  // pixels
    EXPECT_NEAR(double(seen), area, 0.06 * area);
}

/// A view from a random place outside the world towards its middle.
std::string random_view(std::mt19937& random) {
    std::uniform_real_distribution<double> angle(0, 360), height(-6, 6);
    const double turn = angle(random), up = height(random);
    return fmt::format(
        R"("position": [{}, {}, {}], "look_at": [0, 0, 0], "display": {{"shape": "pyramid", "angle": 45}})",
        10 * std::cos(turn), up, 10 * std::sin(turn));
}

std::vector<Body> random_bodies(std::mt19937& random, const std::string& model,
                                const std::string& placement) {
    std::uniform_int_distribution<int> place(-4, 4), quarter(0, 3);
    std::vector<Body> bodies(3);
    for (Body& body : bodies) {
        body.model = model, body.placement = placement;
        for (int& x : body.position) x = place(random);
        for (int& x : body.quarters) x = quarter(random);
    }
    return bodies;
}

constexpr unsigned kSeed = 6126;
const unsigned kSeeds = is_exhaustive() ? 8 : 3;

/// True if `one` equals `other`, or is `other` seen through one voxel of glass more or less.
bool is_next_to(double one, double other, double glass) {
    const double a = one - glass, b = other - glass;
    return std::min({std::abs(a - b), std::abs(a - (1 - kOpacity) * b),
                     std::abs(b - (1 - kOpacity) * a)}) < 2e-6;
}

/// Equal bodies of cubes give the expected colours. Rounding decides whether the voxel whose face
/// holds an exact face comes before it.
TEST_F(InstanceInGlass, ExactBodiesOfWholeVoxelsAreSeenWhereTheirCubesAre) {
    for (unsigned i = 0; i < kSeeds; ++i) {
        const auto shown = [&](const std::string& model) {
            std::mt19937 random(kSeed + i);
            const std::vector<Body> bodies = random_bodies(random, model, "instance");
            return rendered(scene(bodies, random_view(random)));
        };
        const Image cubes = shown("cubes");
        for (const char* model : {"solid", "mesh"}) {
            const Image exact = shown(model);
            for (size_t c = 0; c < 3; ++c)
                for (size_t pixel = 0; pixel < cubes.planes.at("R").size(); ++pixel)
                    ASSERT_TRUE(is_next_to(exact.planes.at(kColors[c])[pixel],
                                           cubes.planes.at(kColors[c])[pixel], kGlass[c]))
                        << model << " pixel " << pixel << ", seed " << kSeed + i;
        }
    }
}

/// The world's voxels come first. Clear bodies of the same shape in both scenes make equal hollows
/// in the cubes, so that the instances' faces lie in the hollows' faces.
TEST_F(InstanceInGlass, InTheSameHollowTheWorldsImageIsShownToTheBit) {
    for (unsigned i = 0; i < kSeeds; ++i)
        for (const char* model : {"solid", "mesh"}) {
            const auto shown = [&](const std::string& placement) {
                std::mt19937 random(kSeed + i);
                const std::vector<Body> bodies = random_bodies(random, model, placement);
                std::string hollows;
                for (const Body& body : bodies)
                    hollows += fmt::format(
                        R"({{"model": "{}", "material": "clear", "priority": 1, "position": [{}, {}, {}], "turn": [{}, {}, {}]}}, )",
                        body.model, body.position[0] * kVoxel, body.position[1] * kVoxel,
                        body.position[2] * kVoxel, 90 * body.quarters[0], 90 * body.quarters[1],
                        90 * body.quarters[2]);
                return rendered(scene(bodies, random_view(random), hollows));
            };
            const Image instances = shown("instance"), world = shown("world");
            for (const char* color : kColors)
                for (size_t pixel = 0; pixel < world.planes.at("R").size(); ++pixel)
                    ASSERT_EQ(instances.planes.at(color)[pixel], world.planes.at(color)[pixel])
                        << model << " pixel " << pixel << ", seed " << kSeed + i;
        }
}

}  // namespace
}  // namespace voxelume
