// SPDX-License-Identifier: Apache-2.0
// Objects that let light through look alike in the world's voxels and as instances: nested ones by
// their priorities, what they absorb, their shadows, and from inside of them.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <vector>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

constexpr const char* kRefracting =
    R"("outer": {"diffuse": 0, "reflection": 1, "refraction": 1, "ior": 1.5, "fresnel": true,
                 "absorption": [0.2, 0.6, 1.2]},
       "inner": {"diffuse": 0, "reflection": 1, "refraction": 1, "ior": 1.2, "fresnel": true,
                 "absorption": [2, 0.3, 0.1]})";
constexpr const char* kSheer = R"("outer": {"color": [0.3, 0.6, 0.9], "opacity": 0.4},
       "inner": {"color": [0.9, 0.5, 0.2], "opacity": 0.5})";
constexpr const char* kFromOutside = R"("position": [0.4, 0.9, 3.2], "look_at": [0, 0, 0])";
constexpr const char* kFromInside = R"("position": [-0.35, 0.1, 0.1], "look_at": [0.3, -0.1, -1])";

/// The parts of a scene with an outer body and an inner one of higher priority, which pass through
/// each other above a floor.
struct GlassScene {
    const char* materials = kRefracting;
    const char *outer = "instance", *inner = "instance";  ///< placements
    std::string ball = R"("shape": "sphere", "radius": 0.55, "surface": "exact")";
    std::string ring = R"("shape": "torus", "radius": 0.5, "tube": 0.16, "surface": "exact")";
    const char* observer = kFromOutside;
    const char* display = R"("shape": "pyramid", "angle": 42)";
    const char* render = R"("shadow": "filtered")";
};

class GlassInstances : public FileTest {
  protected:
    Scene scene(const GlassScene& s) const {
        return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.04, "bounds": {{"min": [-1.6, -0.88, -1.6], "max": [1.6, 1.6, 1.6]}},
          "background": [0.3, 0.4, 0.6], "ambient": [0.2, 0.2, 0.2]}},
"materials": {{{}, "floor": {{"checker": {{"color": [0.2, 0.3, 0.3], "size": [0.3, 0, 0.3]}}}}}},
"models": {{"ball": {{{}}}, "ring": {{{}}},
           "floor": {{"shape": "box", "size": [3, 0.2, 3], "surface": "exact"}}}},
"objects": [
  {{"model": "floor", "material": "floor", "position": [0.01, -0.7, 0], "placement": "world"}},
  {{"model": "ball", "material": "outer", "position": [-0.3, 0.05, 0], "turn": [20, 30, 0],
   "scale": [1, 1.1, 0.9], "placement": "{}"}},
  {{"model": "ring", "material": "inner", "position": [0.1, 0.1, 0.3], "turn": [30, 60, 10],
   "priority": 1, "placement": "{}"}}],
"lights": [{{"type": "point", "position": [1.4, 1.5, 1.2], "intensity": 6}}],
"observer": {{{}, "display": {{{}}}}}, "render": {{"size": [80, 60], {}}}}})",
                                       s.materials, s.ball, s.ring, s.outer, s.inner, s.observer,
                                       s.display, s.render),
                           (folder / "glass.json").string(), {});
    }

    Image picture(const GlassScene& s) const {
        RenderReport report;
        Image image = render(shared_device(), scene(s), report);
        EXPECT_EQ(report.not_finite, 0u);
        return image;
    }

    /// The share of the pixels whose colours differ by more than `by` between `s` and the same
    /// scene in the world's voxels.
    double differing(GlassScene s, double by) const {
        const Image instances = picture(s);
        s.outer = s.inner = "world";
        const Image world = picture(s);
        size_t other = 0;
        const size_t pixels = world.planes.at("R").size();
        for (size_t i = 0; i < pixels; ++i) {
            double max = 0;
            for (const char* c : {"R", "G", "B"})
                max = std::max(max, std::abs(double(world.planes.at(c)[i]) -
                                             double(instances.planes.at(c)[i])));
            other += max > by;
        }
        return double(other) / double(pixels);
    }
};

TEST_F(GlassInstances, OfSolidsLookAsInTheWorld) {
    for (const char* materials : {kRefracting, kSheer})
        for (const char* observer : {kFromOutside, kFromInside})
            for (const char* inner : {"instance", "world"}) {
                const bool is_mixed = std::string(inner) == "world";
                const bool is_inside = observer == kFromInside;
                // By default, each pair of two values occurs, except mixed pairs with sheer ones.
                if (!is_exhaustive() && (is_mixed != is_inside) != (materials == kSheer)) continue;
                if (is_mixed && materials == kSheer && !is_exhaustive()) continue;
                const GlassScene s{.materials = materials, .inner = inner, .observer = observer};
                // A ray that meets an edge of the floor's blocks may go to another one.
                EXPECT_LT(differing(s, 0.002), 0.01) << materials << observer << inner;
            }
}

TEST_F(GlassInstances, OfMeshesLookAsInTheWorld) {
    write_obj(folder / "ball.obj", ball(glm::dvec3(0), 0.55, 24, 12));
    for (const char* materials : {kRefracting, kSheer})
        for (const char* observer : {kFromOutside, kFromInside}) {
            if (materials == kSheer && !is_exhaustive()) continue;
            const GlassScene s{.materials = materials,
                               .ball = R"("mesh": "ball.obj", "surface": "exact")",
                               .observer = observer};
            EXPECT_LT(differing(s, 0.002), 0.01) << materials << observer;
        }
}

/// Smooth objects of the world's voxels unite where they overlap, so one of them is apart. The
/// world's distances are on its lattice, and the instance's on its own.
TEST_F(GlassInstances, OfSmoothObjectsLookAsInTheWorld) {
    for (const char* materials : {kRefracting, kSheer})
        for (const char* observer : {kFromOutside, kFromInside}) {
            if (materials == kSheer && !is_exhaustive()) continue;
            const GlassScene s{.materials = materials,
                               .inner = "world",
                               .ball = R"("shape": "sphere", "radius": 0.55, "surface": "smooth")",
                               .observer = observer};
            EXPECT_LT(differing(s, 0.03), 0.02) << materials << observer;
        }
}

TEST_F(GlassInstances, InGlobalLightLookAsInTheWorldOnAverage) {
    for (const char* materials : {kRefracting, kSheer}) {
        if (materials == kRefracting && !is_exhaustive()) continue;
        GlassScene s{.materials = materials, .render = R"("light": "global", "samples": 16)"};
        const auto mean = [&](const char* placement) {
            s.outer = s.inner = placement;
            const Image image = picture(s);
            double sum = 0;
            for (const float value : image.planes.at("G")) sum += double(value);
            return sum / double(image.planes.at("G").size());
        };
        const double world = mean("world");
        EXPECT_NEAR(mean("instance"), world, 0.003 * world) << materials;
    }
}

/// Layers behind an instance's surface are where they are seen in the world's scene.
TEST_F(GlassInstances, DisplaysOfRaysShowTheLayersBehindThem) {
    GlassScene s{.materials = kSheer,
                 .display = R"("shape": "pyramid", "angle": 42, "near": 1, "far": 6,
                               "layout": "rays", "voxels": [80, 60, 160])"};
    const auto volume = [&](const char* placement) {
        s.outer = s.inner = placement;
        RenderReport report;
        return render_volume(shared_device(), scene(s), report);
    };
    const Volume world = volume("world"), instances = volume("instance");
    ASSERT_GT(world.indices.size(), 4000u);
    std::vector<uint64_t> both;
    std::ranges::set_intersection(world.indices, instances.indices, std::back_inserter(both));
    EXPECT_GT(both.size(), world.indices.size() * 995 / 1000);
    EXPECT_GT(both.size(), instances.indices.size() * 995 / 1000);
}

}  // namespace
}  // namespace voxelume
