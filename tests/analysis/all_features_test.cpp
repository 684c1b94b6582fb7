// SPDX-License-Identifier: Apache-2.0
// A scene with all features at once: the six files of kernels that rays go through, compiled into
// one program.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>
#include <string>

#include "runtime/io/image/png.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/render/illumination.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/finned_ball.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/writers/gltf_writer.hpp"

namespace voxelume {
namespace {

/// A scene with more nested balls of glass than a ray can remember in front of the other objects.
/// The observer is inside a smooth ball.
std::string scene_text(const std::string& light) {
    std::string balls;
    for (int i = 0; i < 17; ++i)
        balls +=
            fmt::format(R"({{"model": "ball", "material": "glass", "scale": {}}},)", 1 - 0.04 * i);
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1.5, -1.1, -2.4], "max": [1.5, 1.3, 1.6]},
          "sky": {"kind": "map", "file": "around.hdr", "samples": 2, "visible": false}, "ambient": [0.2, 0.2, 0.2],
          "medium": {"absorption": [0.1, 0.2, 0.3], "scattering": [0.5, 0.4, 0.3], "anisotropy": 0.25,
                     "density": {"kind": "grid", "file": "fog.vdb", "lit": [1, 0, 0],
                                 "transfer": [{"value": 0, "absorption": 0.2},
                                              {"value": 1, "absorption": 2, "color": [1, 0, 0]}]}}},
"materials": {"glass": {"diffuse": 0.2, "refraction": 0.8, "reflection": 0.2, "fresnel": true,
                        "ior": 1.1, "absorption": [0.1, 0.3, 0.2]},
              "clay": {"color": [0.8, 0.6, 0.4], "checker": {"color": [0.1, 0.2, 0.3], "size": 0.4}},
              "brass": {"base_color": [0.9, 0.7, 0.3], "metallic": 0.8, "roughness": 0.3,
                        "transmission": 0.5, "coat": 0.5, "specular": 0.5},
              "glow": {"emission": [3, 2, 1]}, "veil": {"opacity": 0.5}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "surface": "exact"},
           "lens": {"shape": "sphere", "radius": 0.5, "surface": "smooth"},
           "ice": {"shape": "box", "size": [0.6, 0.5, 0.4], "surface": "cubes", "set": "solid",
                   "normals": "surface"},
           "floor": {"shape": "box", "size": [2.8, 0.2, 3], "surface": "cubes"},
           "thing": {"mesh": "m.gltf", "voxel_size": 0.1, "surface": "exact", "shading": "smooth"},
           "slick": {"mesh": "m.gltf", "voxel_size": 0.1, "surface": "smooth"},
           "nut": {"shape": "union", "surface": "smooth", "parts": [
               {"shape": "difference", "parts": [
                   {"shape": "sphere", "radius": 0.4},
                   {"shape": "sphere", "radius": 0.2, "position": [-0.3, 0.1, 0]}]},
               {"shape": "difference", "position": [0.3, 0.2, 0.1], "parts": [
                   {"shape": "sphere", "radius": 0.3},
                   {"shape": "sphere", "radius": 0.2, "position": [0.2, 0.1, -0.1]}]}]},
           "finned": {"mesh": "fin.obj", "surface": "smooth"},
           "fog": {"voxels": "fog.vdb"}},
"objects": [)" +
           balls + R"(
            {"model": "lens", "material": "glass", "position": [0, 0.1, -2]},
            {"model": "lens", "material": "clay", "position": [0.4, 0.5, -1.8]},
            {"model": "ice", "material": "glass", "position": [-0.8, -0.5, 0.3]},
            {"model": "floor", "material": "clay", "position": [0, -0.9, 0]},
            {"model": "ice", "material": "glow", "position": [0.9, 0.6, 0.4]},
            {"model": "ice", "material": "brass", "position": [0.9, -0.5, 0.9], "turn": [20, 0, 0]},
            {"model": "thing", "material": "veil", "position": [0.5, -0.7, -0.3]},
            {"model": "slick", "material": "glow", "position": [-0.6, 0.6, 0.4]},
            {"model": "nut", "material": "clay", "position": [0.3, 0.4, 1], "placement": "instance"},
            {"model": "finned", "material": "clay", "position": [-0.2, -0.6, 0.9]},
            {"model": "fog", "material": "clay", "position": [-1, 0.3, -0.2]}],
"lights": [{"type": "disk", "position": [0.5, 2, -1], "direction": [0, -1, 0], "radius": 0.2,
            "intensity": 9, "spots": 2}],
"observer": {"position": [0, 0.1, -2.1], "look_at": [0, -0.1, 0], "aperture": 0.02, "blades": 7,
             "display": {"shape": "pyramid", "angle": 60}},
"render": {"size": [24, 18], "depth": 2, "shadow": "filtered", "light": ")" +
           light + "\"}}";
}

/// Writes a grid of half transparent voxels of two colours.
void write_fog(const std::filesystem::path& path) {
    const std::vector<glm::ivec3> cells = {{0, 0, 0}, {1, 0, 0}, {2, 1, 0}, {2, 2, 1}};
    const std::vector<float> values = {0.5f, 0.25f, 0.5f, 0.75f};
    const std::vector<glm::vec3> colors = {{1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {0, 1, 0}};
    VdbVolume volume;
    volume.cells = cells;
    volume.values = values;
    volume.colors = colors;
    volume.voxel_edges = glm::dvec3(0.2);
    write_vdb(path, volume);
}

/// A glTF file of a mesh with a texture through which half of the light passes, and with a map.
std::string textured_tetrahedron() {
    GltfWriter writer;
    const std::vector<float> positions = {0, 0, 0, 0.5f, 0, 0, 0, 0.5f, 0, 0, 0, 0.5f};
    const std::vector<float> uvs = {0, 0, 1, 0, 0, 1, 1, 1};
    const std::vector<uint16_t> corners = {0, 2, 1, 0, 1, 3, 1, 2, 3, 2, 0, 3};
    const int p = writer.accessor(positions, "VEC3", 3), t = writer.accessor(uvs, "VEC2", 2);
    const int i = writer.accessor(corners, "SCALAR", 1);
    Image texel{1, 1, {}, {}, {}};
    for (const char* channel : {"R", "G", "B", "A"}) texel.planes[channel] = Plane<float>{0.5f};
    const std::string png = GltfWriter::base64(png_bytes(texel, {.keep_alpha = true}));
    writer.json["images"] = {{{"uri", "data:image/png;base64," + png}}};
    writer.json["textures"] = {{{"source", 0}}};
    writer.json["materials"] = {{{"alphaMode", "BLEND"},
                                 {"emissiveFactor", {1, 1, 1}},
                                 {"emissiveTexture", {{"index", 0}}},
                                 {"pbrMetallicRoughness", {{"baseColorTexture", {{"index", 0}}}}}}};
    writer.show(p, t, i);
    return writer.gltf();
}

class FilesOfAllFeatures : public FileTest {
  protected:
    Scene scene_in(const char* light) const {
        put_bytes(folder / "m.gltf", textured_tetrahedron());
        write_fog(folder / "fog.vdb");
        put_bytes(folder / "around.hdr",
                  "#?RADIANCE\n\n-Y 1 +X 2\n\x40\x50\x60\x80\x20\x20\x20\x80");
        write_obj(folder / "fin.obj", finned_ball(0.02, 0.6, 24));
        Scene scene = parse_scene(scene_text(light), folder / "s.json", {});
        const auto finned = std::ranges::find(scene.models, "finned", &Model::name);
        finned->thin_edge = 0.1;  // its fin is exact
        return scene;
    }
};

class AllFeatures : public FilesOfAllFeatures, public testing::WithParamInterface<const char*> {
  protected:
    Scene scene_here() const { return scene_in(GetParam()); }
};

INSTANTIATE_TEST_SUITE_P(Lights, AllFeatures, testing::Values("local", "global"));

TEST_P(AllFeatures, AreInOneProgramOfAllFiles) {
    const Scene scene = scene_here();
    const bool is_global = scene.render.light == LightMode::global;
    const Device& device = shared_device();
    RenderReport report;
    const BuiltWorld world = WorldBuilder(device, false).build(scene, report.world);
    const std::set<std::string> of_global = {"VXL_GLOBAL",     "VXL_EMITTERS",    "VXL_PHYSICAL",
                                             "VXL_SKY_RAYS",   "VXL_ROUGH_GLASS", "VXL_COAT",
                                             "VXL_SCATTERING", "VXL_WEAK_FACETS", "VXL_NEAR_LIGHT"};
    for (const auto& [name, value] : features_of(scene, world.pyramid).defines(device)) {
        const bool is_absent =
            is_global ? name == std::string("VXL_TINTED") : of_global.contains(name);
        // Displays alone ask for the own light of surfaces, and passes for direct light alone; in a
        // medium that scatters, physically based surfaces leave lights to rays. Only worlds of
        // nothing else test all solids at once. many_area_lights_test has more than eight lights.
        // A single sample lies in the middle of its pixel.
        const std::set<std::string> of_others = {"VXL_OWN_LIGHT",       "VXL_AREA_SHARES",
                                                 "VXL_DIRECT_ALONE",    "VXL_SOLIDS_AHEAD",
                                                 "VXL_SCATTERED_SIGHT", "VXL_CHOSEN_AREAS"};
        EXPECT_TRUE(value != 0 || is_absent || name == "VXL_NATIVE_DIVIDE" ||
                    of_others.contains(name))
            << name;
    }

    DeviceCounters& counters = device.counters();
    counters.launches.clear();
    // The kernels that list the emissive surface form a separate program, because rays don't need
    // them.
    const Program lists(device, "light_samples.cl",
                        features_of(scene, world.pyramid).defines(device));
    // The kernel that finds the brightness of the surface's map is also in a separate program.
    if (!is_global)
        Program(device, "emission_maps.cl", features_of(scene, world.pyramid).defines(device));
    const uint64_t before = counters.programs_built;
    const Image image = Renderer(device, false).new_image(scene, world, report);
    // GPUs compile each kernel alone.
    if (device.is_cpu()) {
        EXPECT_EQ(counters.programs_built - before, 1u);
    }
    for (const char* kernel : {"cast_sight", "begin_paths", "begin_inside", "trace_closest",
                               "shade_surface", "trace_shadows", "absorb_sight", "list_emissive"})
        EXPECT_GT(counters.launches[kernel], 0u) << kernel;
    for (const char* kernel : {"add_light", "pass_layer", "scatter_rays", "gather_light",
                               "add_sky_light", "mean_emission_maps"})
        EXPECT_EQ(counters.launches[kernel] > 0, !is_global) << kernel;
    for (const char* kernel :
         {"add_area_light", "extend_paths", "scatter_in_medium", "add_area_light_to_medium",
          "extend_in_medium", "find_near_points", "add_near_light"})
        EXPECT_EQ(counters.launches[kernel] > 0, is_global) << kernel;
    EXPECT_EQ(report.not_finite, 0u);
    const Plane<float>& red = image.planes.at("R");
    const auto [minimum, maximum] = std::ranges::minmax(red);
    EXPECT_GT(maximum, minimum);
}

/// By default, only one of the other numbers of lanes runs.
TEST_P(AllFeatures, HaveTheSameBitsOnAnyNumberOfLanes) {
    const bool is_global = GetParam() == std::string("global");
    const Scene scene = scene_here();
    std::vector<int> others = {1, 4, 8, 16};
    std::erase(others, shared_device().lanes());
    const auto hash_on = [&](const Device& device) {
        RenderReport report;
        return oracle::image_hash(render(device, scene, report));
    };
    const uint64_t expected = hash_on(shared_device());
    for (const int lanes : in_turn(others, is_global ? 1 : 2))
        EXPECT_EQ(hash_on(test_device(lanes)), expected) << lanes;
}

/// This case has no medium that scatters paths and no shadows that let light through: then
/// physically based surfaces share lights with rays.
TEST_F(FilesOfAllFeatures, AreThereWithLightsThatPathsMeet) {
    Scene scene = scene_in("global");
    scene.world.medium.scattering = {0, 0, 0};
    scene.render.filtered_shadows = false;
    const Device& device = shared_device();
    RenderReport report;
    const BuiltWorld world = WorldBuilder(device, false).build(scene, report.world);
    const std::set<std::string> shown = {"VXL_AREA_SHARES", "VXL_EMITTERS", "VXL_PHYSICAL",
                                         "VXL_ROUGH_GLASS", "VXL_SKY_RAYS", "VXL_COAT",
                                         "VXL_INSTANCES",   "VXL_TEXTURES"};
    size_t found = 0;
    for (const auto& [name, value] : features_of(scene, world.pyramid).defines(device)) {
        found += shown.contains(name);
        EXPECT_TRUE(value != 0 || !shown.contains(name)) << name;
    }
    EXPECT_EQ(found, shown.size());
    device.counters().launches.clear();
    const Image image = Renderer(device, false).new_image(scene, world, report);
    EXPECT_GT(device.counters().launches["meet_area_light"], 0u);
    EXPECT_EQ(report.not_finite, 0u);
    const int lanes = device.lanes() == 4 ? 8 : 4;
    EXPECT_EQ(oracle::image_hash(render(test_device(lanes), scene, report)),
              oracle::image_hash(image));
}

}  // namespace
}  // namespace voxelume
