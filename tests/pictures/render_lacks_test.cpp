// SPDX-License-Identifier: Apache-2.0
// Images of scenes without some features: what they lack takes no kernel, no buffer, no constant.
#include <gmock/gmock.h>

#include <map>
#include <set>

#include "runtime/analysis/scene_features.hpp"
#include "tests/pictures/light/box_scene.hpp"

namespace voxelume {
namespace {

using testing::Contains;
using testing::ElementsAre;
using testing::Key;
using testing::Not;

TEST(Render, WhatASceneDoesNotHaveIsNotAllocatedOrLaunched) {
    const Rendered plain = rendered(scene_of(box_scene("cubes", "")));
    for (const char* kernel : {"add_light", "trace_shadows", "absorb_sight", "absorb_shadows"})
        EXPECT_THAT(plain.counters.launches, Not(Contains(Key(std::string(kernel))))) << kernel;
    EXPECT_THAT(plain.counters.allocated_bytes, Not(Contains(Key(std::string("shadow queue")))));

    std::string unshadowed = box_scene(
        "cubes",
        R"({"type": "directional", "direction": [0, 0, 1], "color": [1, 1, 1], "intensity": 1})");
    unshadowed.replace(unshadowed.find("\"render\": {"), 11, "\"render\": {\"shadows\": false, ");
    const Rendered lit = rendered(scene_of(unshadowed));
    EXPECT_THAT(lit.counters.launches, Contains(Key(std::string("add_light"))));
    EXPECT_THAT(lit.counters.launches, Not(Contains(Key(std::string("trace_shadows")))));
    EXPECT_THAT(lit.counters.allocated_bytes, Not(Contains(Key(std::string("shadow queue")))));
}

template <class T>
std::vector<std::string> names(const std::map<std::string, T>& counters) {
    std::vector<std::string> all;
    for (const auto& [name, value] : counters) all.push_back(name);
    return all;
}

TEST(Render, ASceneOfPlainCubesHasNothingElseInIt) {
    // One object of cubes without lights uses only these features, kernels and buffers.
    const Scene scene = scene_of(box_scene("cubes", ""));
    const Rendered r = rendered(scene);
    const Device device = test_device();
    WorldReport report;
    const Features features = features_of(scene, build_world(device, scene, report));
    std::set<std::string> expected = {"VXL_CUBES"};
    expected.insert(
        {"VXL_RADIANCE", "VXL_POSITIONS", "VXL_NORMALS", "VXL_HIT_ATTRIBUTES"});  // asked for
    if (device.is_cpu()) expected.insert("VXL_NATIVE_DIVIDE");
    expected.insert("VXL_SOLID_KINDS");  // those of solids, if there were any
    for (const auto& [name, value] : features.defines(device))
        EXPECT_EQ(value != 0, expected.contains(name)) << name;
    EXPECT_THAT(
        names(r.counters.launches),
        ElementsAre("cast_sight", "classify_bricks", "classify_solid_bricks", "clear_bricks",
                    "mark_near_leaves", "mark_voxels", "occupy_solid", "paint_cubes",
                    "resolve_pixels", "shade_surface", "trace_closest", "write_voxels"));
    EXPECT_THAT(
        names(r.counters.allocated_bytes),
        ElementsAre("brick records", "brick states", "cleared bricks", "coordinates",
                    "hit attributes", "hits", "image", "index counts", "index leaf masks",
                    "index masks", "index starts", "leaf voxels", "leaves", "materials",
                    "materials of groups", "near leaves", "normals", "not finite", "object numbers",
                    "occupancy", "painted bricks", "placement", "positions", "radiance", "rays",
                    "sample offsets", "sectors", "slots", "solids", "undecided count",
                    "undecided voxels", "world coordinates", "world occupancy", "world slots"));
}

TEST(Render, ALightWithoutIntensityIsNotShaded) {
    const Rendered r = rendered(scene_of(box_scene(
        "cubes",
        R"({"type": "point", "position": [0, 0, -2], "color": [1, 1, 1], "intensity": 0})")));
    EXPECT_THAT(r.counters.launches, Not(Contains(Key(std::string("add_light")))));
}

}  // namespace
}  // namespace voxelume
