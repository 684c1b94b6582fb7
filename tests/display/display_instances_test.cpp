// SPDX-License-Identifier: Apache-2.0
// Displays of layout `lattice` show objects alike in the world's voxels and as instances.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/mat4x4.hpp>
#include <iterator>
#include <set>
#include <string>
#include <utility>
#include <vector>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

/// Four solids of all surfaces before a turned display whose voxels aren't the world's. `maps`
/// places each of them.
Scene lattice_scene(const std::string& placement, const std::array<std::string, 4>& maps,
                    const std::string& visibility, float opacity = 1) {
    std::string objects;
    const std::array<const char*, 4> models = {"smooth", "exact", "cubes", "solid cubes"};
    for (size_t i = 0; i < models.size(); ++i)
        objects += fmt::format(R"({{"model": "{}", "material": "m{}", "placement": "{}", {}}},)",
                               models[i], i, placement, maps[i]);
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.0625, "bounds": {{"min": [-2, -2, -2], "max": [2, 2, 2]}},
          "ambient": [0.2, 0.2, 0.2]}},
"materials": {{"m0": {{"color": [1, 0.5, 0.2]}}, "m1": {{"color": [0.2, 0.5, 1]}},
              "m2": {{"color": [0.3, 1, 0.4]}}, "m3": {{"color": [0.9, 0.9, 0.4]}},
              "clear": {{"opacity": {}}}}},
"models": {{"smooth": {{"shape": "torus", "radius": 0.4, "tube": 0.17, "surface": "smooth"}},
           "exact": {{"shape": "cylinder", "radius": 0.3, "height": 0.7, "surface": "exact"}},
           "cubes": {{"shape": "sphere", "radius": 0.35, "surface": "cubes"}},
           "solid cubes": {{"shape": "box", "size": [0.5, 0.75, 0.375], "surface": "cubes",
                           "set": "solid"}},
           "pane": {{"shape": "box", "size": [2, 2, 0.1], "surface": "exact"}}}},
"objects": [{} {{"model": "pane", "material": "clear", "position": [0, 0, 1.2]}}],
"lights": [{{"type": "point", "position": [2, 3, 4], "intensity": 30}}],
"observer": {{"position": [1.5, 1.2, 4], "look_at": [0, 0, 0],
             "display": {{"shape": "box", "size": [3, 2.6, 3.4], "near": 2.8, "layout": "lattice",
                         "voxels": [52, 44, 60], "visibility": "{}"}}}}}})",
                                   opacity, objects, visibility),
                       "lattice.json", {});
}

Volume lattice_volume(const Scene& scene, size_t instances) {
    RenderReport report;
    Volume volume = render_volume(test_device(), scene, report);
    EXPECT_EQ(report.world.instances.instances, instances);
    EXPECT_EQ(report.not_finite, 0u);
    EXPECT_GT(volume.indices.size(), 1000u);
    return volume;
}

/// Moves by whole voxels of the world and quarter turns.
constexpr std::array<const char*, 4> kWholeMaps = {
    R"("position": [-0.5, 0.5, 0], "turn": [90, 0, 0])",
    R"("position": [0.75, 0.625, 0.25], "turn": [0, 90, 0])",
    R"("position": [-0.5, -0.75, 0.5], "turn": [0, 0, 180])",
    R"("position": [0.75, -0.75, -0.25], "scale": [-1, 1, 1])"};

std::array<std::string, 4> whole_maps() {
    return {kWholeMaps[0], kWholeMaps[1], kWholeMaps[2], kWholeMaps[3]};
}

TEST(DisplayOfInstances, OfWholeVoxelsIsThatOfTheWorld) {
    for (const char* visibility : {"observer", "outside"}) {
        const Volume world = lattice_volume(lattice_scene("world", whole_maps(), visibility), 0);
        const Volume instances =
            lattice_volume(lattice_scene("instance", whole_maps(), visibility), 4);
        EXPECT_EQ(world.indices, instances.indices) << visibility;
        EXPECT_EQ(world.objects, instances.objects) << visibility;
        ASSERT_EQ(world.colors.size(), instances.colors.size());
        size_t other = 0;
        for (size_t i = 0; i < world.colors.size(); ++i)
            other += glm::distance(world.colors[i], instances.colors[i]) > 1e-4f;
        // Points on edges of cubes have the light of one face or of the other.
        EXPECT_LT(other, world.colors.size() / 50) << visibility;
    }
}

/// The fraction of one volume's voxels without a voxel of the other volume next to them.
double lonely_part(const Volume& volume, const Volume& other) {
    const glm::ivec3& size = volume.frame.size;
    const std::set<uint64_t> shown(other.indices.begin(), other.indices.end());
    size_t lonely = 0;
    for (const uint64_t index : volume.indices) {
        bool has_neighbor = false;
        for (int i = 0; i < 27; ++i)
            has_neighbor |= shown.contains(
                index +
                uint64_t(int64_t(i % 3 - 1 + size.x * (i / 3 % 3 - 1 + size.y * (i / 9 - 1)))));
        lonely += !has_neighbor;
    }
    return double(lonely) / double(volume.indices.size());
}

TEST(DisplayOfInstances, ShowsTurnedAndStretchedOnesWhereTheyAre) {
    const std::array<std::string, 4> maps = {
        R"("position": [-0.5, 0.5, 0], "turn": [33, 20, 0], "scale": [1.1, 0.9, 1])",
        R"("position": [0.77, 0.61, 0.2], "turn": [10, 50, 70])",
        R"("position": [-0.53, -0.71, 0.47], "turn": [0, 30, 15], "scale": 1.2)",
        R"("position": [0.7, -0.72, -0.3], "turn": [20, 15, 40], "scale": [-1, 1, 1])"};
    const Volume world = lattice_volume(lattice_scene("world", maps, "outside"), 0);
    const Volume instances = lattice_volume(lattice_scene("instance", maps, "outside"), 4);
    EXPECT_LT(lonely_part(world, instances), 0.001);
    EXPECT_LT(lonely_part(instances, world), 0.001);
}

/// The opacities of a pane in front of instances come from a second scan, which finds instances,
/// too.
TEST(DisplayOfInstances, BehindAPaneIsThatOfTheWorld) {
    const Volume world = lattice_volume(lattice_scene("world", whole_maps(), "observer", 0.4f), 0);
    const Volume instances =
        lattice_volume(lattice_scene("instance", whole_maps(), "observer", 0.4f), 4);
    EXPECT_EQ(world.indices, instances.indices);
    EXPECT_EQ(world.opacities, instances.opacities);
}

/// A ball of glass in bright surroundings of the same index. It emits no light itself.
Scene clear_ball(const std::string& surface, const std::string& placement,
                 const std::string& absorption, const std::string& render) {
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.03, "bounds": {{"min": [-1, -1, -1], "max": [1, 1, 1]}},
          "background": [0.5, 0.25, 0.125]}},
"materials": {{"clear": {{"color": [0, 0, 0], "refraction": 1, "ior": 1, "absorption": {}}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.5, "surface": "{}"}}}},
"objects": [{{"model": "ball", "material": "clear", "placement": "{}",
             "position": [0.12, -0.06, 0.21]}}],
"observer": {{"position": [0.3, 0.4, 3], "look_at": [0.1, 0, 0],
             "display": {{"shape": "pyramid", "angles": [24, 22], "near": 2, "far": 3.6,
                         "layout": "lattice", "voxels": [22, 20, 17], "visibility": "observer"}}}},
"render": {}}})",
                                   absorption, surface, placement, render),
                       "ball.json", {});
}

/// The minimum and maximum length, inside the ball, of lines from E through a voxel's points.
std::array<double, 2> ways_in_ball(const VolumeFrame& frame, const glm::ivec3& voxel) {
    constexpr int kSteps = 8;
    const glm::dvec3 middle =
        glm::dvec3(glm::inverse(frame.world_from_observer) * glm::dvec4(0.12, -0.06, 0.21, 1));
    std::array<double, 2> ways = {INFINITY, 0};
    for (int i = 0; i < (kSteps + 1) * (kSteps + 1) * (kSteps + 1); ++i) {
        const glm::dvec3 part = glm::dvec3(i % 9, i / 9 % 9, i / 81) / double(kSteps);
        const glm::dvec3 way =
            glm::normalize(frame.origin + frame.edge * (glm::dvec3(voxel) + part));
        const double squared = 0.25 - glm::dot(glm::cross(way, middle), glm::cross(way, middle));
        const double length = 2 * std::sqrt(std::max(squared, 0.0));
        ways = {std::min(ways[0], length), std::max(ways[1], length)};
    }
    return ways;
}

/// Checks that voxels of the ball show the background behind it, by what the ball absorbs of it.
void expect_background(const Volume& volume, const glm::dvec3& absorption) {
    constexpr double kFloat = 0.002;  // a smooth ball's radius is that of its field
    const glm::dvec3 background(0.5, 0.25, 0.125);
    const glm::ivec3 size = volume.frame.size;
    size_t outside = 0;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const int index = int(volume.indices[i]);
        const std::array<double, 2> ways = ways_in_ball(
            volume.frame, {index % size.x, index / size.x % size.y, index / size.x / size.y});
        for (int c = 0; c < 3; ++c) {
            const double low = background[c] * std::exp(-absorption[c] * ways[1]),
                         high = background[c] * std::exp(-absorption[c] * ways[0]);
            outside += volume.colors[i][c] < low - kFloat || volume.colors[i][c] > high + kFloat;
        }
        EXPECT_EQ(volume.opacities[i], 1);
    }
    EXPECT_EQ(outside, 0u) << "of " << volume.indices.size() << " voxels";
}

/// Between equal media the refracted ray goes on straight. It once ended where the ray that looked
/// at the voxel did, shortly behind it, so that nothing was behind glass of the world's voxels.
/// Rays that graze a field cross it many times.
TEST(DisplayOfInstances, ShowsWhatIsBehindGlassOfItsSurroundingsIndex) {
    const std::array<std::pair<const char*, glm::dvec3>, 2> absorptions = {
        std::pair{"[0, 0, 0]", glm::dvec3(0)}, {"[4, 0.5, 1.5]", {4, 0.5, 1.5}}};
    for (const char* render :
         {R"({"samples": 1, "depth": 12})", R"({"light": "global", "samples": 4, "bounces": 12})"})
        for (const char* surface : {"exact", "smooth"})
            for (const auto& [text, absorption] : absorptions) {
                SCOPED_TRACE(fmt::format("{} {} {}", render, surface, text));
                std::array<std::set<uint64_t>, 2> shown;
                for (size_t i = 0; i < 2; ++i) {
                    RenderReport report;
                    const Volume volume = render_volume(
                        test_device(),
                        clear_ball(surface, i == 0 ? "world" : "instance", text, render), report);
                    EXPECT_EQ(report.world.instances.instances, i);
                    expect_background(volume, absorption);
                    shown[i] = {volume.indices.begin(), volume.indices.end()};
                    EXPECT_GT(shown[i].size(), 200u);
                }
                std::vector<uint64_t> others;
                std::ranges::set_symmetric_difference(shown[0], shown[1],
                                                      std::back_inserter(others));
                EXPECT_LE(others.size(), 4u) << shown[0].size();
            }
}

}  // namespace
}  // namespace voxelume
