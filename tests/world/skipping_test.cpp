// SPDX-License-Identifier: Apache-2.0
// Work that a scene doesn't need isn't done. Each row of the table is a change of a scene and the
// counters that are zero after it but weren't before.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>
#include <numeric>

#include "kernels/shared/voxel.h"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A scene of a floor in a medium, with a mirroring ball and a mesh above it.
constexpr const char* kSkippingScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1.2, 1.4]},
          "ambient": [0.1, 0.2, 0.3], "medium": {"absorption": [0.1, 0.2, 0.3]}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4], "diffuse": 0.9, "specular": 0},
              "steel": {"diffuse": 0.2, "reflection": 0.5},
              "veil": {"opacity": 0.5}},
"models": {"floor": {"shape": "box", "size": [1.8, 0.1, 2], "surface": "cubes"},
           "ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"},
           "thing": {"mesh": "m.obj", "voxel_size": 0.05, "surface": "smooth"}},
"objects": [{"model": "floor", "material": "clay", "position": [0, -0.8, 0]},
            {"model": "ball", "material": "steel", "position": [0.1, -0.2, 0.2]},
            {"model": "thing", "material": "veil", "position": [-0.7, -0.5, 0]}],
"lights": [{"type": "point", "position": [0.5, 3, -1], "intensity": 9}],
"observer": {"position": [0.2, 0.7, -3], "look_at": [0, -0.3, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [48, 36], "depth": 2}})";

/// A scene of the floor alone, without the medium.
constexpr const char* kFloor = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1.2, 1.4]}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4], "diffuse": 0.9, "specular": 0}},
"models": {"floor": {"shape": "box", "size": [1.8, 0.1, 2], "surface": "cubes"}},
"objects": [{"model": "floor", "material": "clay", "position": [0, -0.8, 0]}],
"lights": [{"type": "point", "position": [0.5, 3, -1], "intensity": 9}],
"observer": {"position": [0.2, 0.7, -3], "look_at": [0, -0.3, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [48, 36], "depth": 2}})";

/// A scene of an emissive object above the floor.
constexpr const char* kEmissive = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1.2, 1.4]}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4]}, "glow": {"emission": [3, 2, 1]}},
"models": {"floor": {"shape": "box", "size": [1.8, 0.1, 2], "surface": "cubes"},
           "ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"}},
"objects": [{"model": "floor", "material": "clay", "position": [0, -0.8, 0]},
            {"model": "ball", "material": "glow", "position": [0, 0.2, 0]}],
"observer": {"position": [0.2, 0.7, -3], "look_at": [0, -0.3, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [48, 36], "depth": 2}})";

/// The counters of one frame rendered from nothing. A key is "kernel" or "buffer" and its name, or
/// "report" and a field's name.
using Counters = std::map<std::string, uint64_t>;

struct Row {
    const char* name;
    const char* scene;
    const char* from;
    const char* to;
    std::vector<const char*> zeros;
};

std::string replaced(std::string text, const std::string& from, const std::string& to) {
    const size_t place = text.find(from);
    EXPECT_NE(place, std::string::npos) << from;
    return text.replace(place, from.size(), to);
}

class SkippingFiles : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "m.obj",
                  "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    }

    Scene scene_of(const std::string& text) const {
        return parse_scene(text, folder / "s.json", {});
    }

    static Counters show(const Scene& scene, Image* image = nullptr) {
        DeviceCounters& device = shared_device().counters();
        device.launches.clear();
        device.allocated_bytes.clear();
        RenderReport report;
        Image shown = render(shared_device(), scene, report);
        if (image) *image = std::move(shown);
        Counters counters;
        for (const auto& [name, count] : device.launches) counters["kernel " + name] = count;
        for (const auto& [name, bytes] : device.allocated_bytes) counters["buffer " + name] = bytes;
        counters["report shadow_rays"] = report.shadow_rays;
        counters["report secondary_rays"] = report.secondary_rays;
        counters["report voxels"] = report.voxels;
        counters["report voxelized"] = report.world.voxelized;
        counters["report meshes_read"] = report.world.meshes_read;
        return counters;
    }
};

const Row kRows[] = {
    {"a light without intensity",
     kFloor,
     "\"intensity\": 9",
     "\"intensity\": 0",
     {"kernel add_light", "kernel trace_shadows", "buffer shadow queue", "buffer shadow rays"}},
    {"a light behind all surfaces",
     kFloor,
     "[0.5, 3, -1]",
     "[0.5, -3, -1]",
     {"report shadow_rays"}},
    {"a black material",
     kFloor,
     "\"diffuse\": 0.9",
     "\"diffuse\": 0",
     {"kernel add_light", "kernel trace_shadows", "buffer shadow queue", "report shadow_rays"}},
    {"a material of black colour",
     kFloor,
     "[0.8, 0.6, 0.4]",
     "[0, 0, 0]",
     {"kernel add_light", "kernel trace_shadows", "buffer shadow queue", "report shadow_rays"}},
    {"no shadows asked for",
     kFloor,
     "\"depth\": 2",
     "\"depth\": 2, \"shadows\": false",
     {"kernel trace_shadows", "report shadow_rays", "buffer shadow queue"}},
    {"a picture of nothing",
     kFloor,
     "\"look_at\": [0, -0.3, 0]",
     "\"look_at\": [0, 9, -3.5]",
     {"kernel add_light", "kernel trace_shadows", "buffer shadow queue", "report shadow_rays"}},
    {"an object outside the world",
     kFloor,
     "[0, -0.8, 0]",
     "[0, -8, 0]",
     {"kernel add_light", "kernel trace_shadows", "buffer shadow queue", "report voxelized",
      "report voxels", "report shadow_rays"}},
    {"a mesh outside the world",
     kSkippingScene,
     "[-0.7, -0.5, 0]",
     "[-0.7, -5, 0]",
     {"kernel measure_distances", "kernel pass_layer", "buffer coverage", "buffer path media"}},
    {"a mirror outside the world",
     kSkippingScene,
     "[0.1, -0.2, 0.2]",
     "[0.1, -9, 0.2]",
     {"kernel scatter_rays", "kernel gather_light"}},
    {"an emissive object outside the world",
     kEmissive,
     "[0, 0.2, 0]",
     "[0, 9, 0]",
     {"kernel find_surface", "kernel list_emissive", "kernel add_light", "kernel trace_shadows",
      "buffer shadow queue"}},
    {"a mesh that isn't shown",
     kSkippingScene,
     "\"model\": \"thing\"",
     "\"model\": \"thing\", \"visible\": false",
     {"report meshes_read", "kernel measure_distances", "kernel pass_layer"}},
    {"nothing transparent",
     kSkippingScene,
     "\"opacity\": 0.5",
     "\"opacity\": 1",
     {"kernel pass_layer", "buffer coverage", "buffer path media", "buffer node coverage"}},
    {"no reflection",
     kSkippingScene,
     "\"reflection\": 0.5",
     "\"reflection\": 0",
     {"kernel scatter_rays", "kernel gather_light"}},
    {"a depth of 0",
     kSkippingScene,
     "\"depth\": 2",
     "\"depth\": 0",
     {"kernel scatter_rays", "kernel gather_light"}},
    {"no medium",
     kSkippingScene,
     "\"absorption\": [0.1, 0.2, 0.3]",
     "\"absorption\": [0, 0, 0]",
     {"kernel absorb_sight", "buffer transmittance"}},
};

TEST_F(SkippingFiles, WhatAChangeMakesNeedlessIsNotDone) {
    std::map<const char*, Counters> all;
    for (const char* scene : {kSkippingScene, kFloor, kEmissive})
        all[scene] = show(scene_of(scene));
    for (const Row& row : kRows) {
        const Counters& before = all.at(row.scene);
        Counters after = show(scene_of(replaced(row.scene, row.from, row.to)));
        for (const char* name : row.zeros) {
            EXPECT_TRUE(before.contains(name) && before.at(name) > 0) << row.name << ": " << name;
            EXPECT_EQ(after[name], 0u) << row.name << ": " << name;
        }
    }
}

TEST_F(SkippingFiles, WhateverItsMaterialAnObjectOutsideTheWorldIsNotInThePicture) {
    const auto changes = std::to_array<void (*)(Material&)>({
        [](Material& m) { m.reflection = 0.5f; },
        [](Material& m) { m.refraction = 0.9f, m.absorption = glm::vec3(1, 2, 3); },
        [](Material& m) { m.refraction = 0.9f, m.reflection = 0.1f, m.fresnel = true; },
        [](Material& m) { m.opacity = 0.3f; },
        [](Material& m) { m.emission = glm::vec3(3, 2, 1); },
        [](Material& m) {
            m.checker = {glm::vec3(0, 1, 0), glm::dvec3(0.2), glm::dvec3(0)};
        },
    });
    Scene scene = scene_of(kEmissive);
    scene.objects[1].visible = false;
    Image without;
    show(scene, &without);
    for (const auto& change : changes) {
        scene = scene_of(replaced(kEmissive, "[0, 0.2, 0]", "[0, 9, 0]"));
        Material& material = scene.materials[size_t(scene.objects[1].material)];
        material.emission = glm::vec3(0);
        change(material);
        Image image;
        show(scene, &image);
        EXPECT_EQ(image.planes, without.planes);
    }
}

TEST_F(SkippingFiles, AFloorOfOneColourHasNoBuffersForMore) {
    Counters counters = show(scene_of(kFloor));
    for (const char* name : {"voxel attributes", "voxel colors", "voxel fields", "primitives",
                             "primitive starts", "paths", "path media", "coverage", "sides",
                             "transmittance", "instances", "medium densities"})
        EXPECT_EQ(counters[std::string("buffer ") + name], 0u) << name;
}

TEST_F(SkippingFiles, TilesThatSeeNothingEndAtOnce) {
    Scene scene = scene_of(kFloor);
    resize(scene, {256, 256});
    RenderReport report;
    const Image image = render(shared_device(), scene, report);
    const Plane<uint32_t>& objects = image.id_planes.at("objectId");
    std::vector<bool> is_empty(64 * 64, true);
    for (size_t i = 0; i < objects.size(); ++i)
        if (objects[i] != 0) is_empty[i / 1024 * 64 + i % 256 / 4] = false;
    const auto empty = uint64_t(std::ranges::count(is_empty, true));
    EXPECT_GT(empty, 2000u);
    EXPECT_EQ(report.beams, is_empty.size());
    EXPECT_LE(report.clear_beams, empty);
    EXPECT_GT(report.clear_beams, empty * 3 / 5);
}

TEST_F(SkippingFiles, EmptySpaceTakesNoVoxelsLeavesOrFields) {
    Counters small = show(scene_of(kSkippingScene));
    Counters large = show(scene_of(replaced(kSkippingScene, "[1, 1.2, 1.4]", "[7.4, 7.6, 7.8]")));
    EXPECT_EQ(large["report voxels"], small["report voxels"]);
    for (const char* name : {"buffer leaves", "buffer leaf voxels", "buffer voxel fields"})
        EXPECT_EQ(large[name], small[name]) << name;
    // There are 64 records of 16 bytes for each sector of 64³ voxels that isn't empty.
    EXPECT_EQ(large["buffer brick records"], small["buffer brick records"]);
}

}  // namespace
}  // namespace voxelume
