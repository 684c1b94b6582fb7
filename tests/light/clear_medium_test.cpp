// SPDX-License-Identifier: Apache-2.0
// A medium of density 0 everywhere is left out: it causes no kernels, buffers or features.
#include <gtest/gtest.h>

#include <array>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/memory/plan.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A scene of a ball of glass or clay in fog.
constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1.2, 1.4]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.2, 0.3],
          "medium": {"absorption": [0.4, 0.2, 0.3], "color": [0.5, 0.6, 0.7], "density": DENSITY}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4]},
              "glass": {"diffuse": 0.1, "refraction": 0.8, "ior": 1.5}},
"models": {"ball": {"shape": "sphere", "radius": 0.5, "surface": "smooth"}},
"objects": [{"model": "ball", "material": "MATERIAL", "position": [0, 0, 0.2]}],
"lights": [{"type": "point", "position": [0.5, 3, -1], "intensity": 9}],
"observer": {"position": [0.2, 0.7, -3], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angle": 40, "far": 6, "voxels": [16, 12, 9],
                         "layout": "rays"}},
"render": {"size": [48, 36], "depth": 2}})";

struct Picture {
    Image image;
    std::map<std::string, uint64_t> launches, bytes;
};

class ClearMedium : public FileTest {
  protected:
    Scene scene(std::string text, const std::string& density, const std::string& material) const {
        text.replace(text.find("DENSITY"), 7, density);
        text.replace(text.find("MATERIAL"), 8, material);
        return parse_scene(text, folder / "s.json", {});
    }
    Scene foggy(const std::string& density, const std::string& material = "clay") const {
        return scene(kScene, density, material);
    }
    Scene without_fog(const std::string& material) const {
        Scene scene = foggy(R"({"kind": "height", "base": 0, "scale_height": 1})", material);
        scene.world.medium = {};
        return scene;
    }
    /// Writes a grid of two cells with these values in a background.
    void write_grid(const char* name, float first, float second, float background) const {
        const std::array cells = {glm::ivec3(0), glm::ivec3(3, 2, 1)};
        const std::array values = {first, second};
        VdbVolume volume;
        volume.cells = cells;
        volume.values = values;
        volume.background = background;
        volume.voxel_edges = glm::dvec3(0.2);
        write_vdb(folder / name, volume);
    }
    static Picture show(const Scene& scene) {
        DeviceCounters& device = shared_device().counters();
        device.launches.clear();
        device.allocated_bytes.clear();
        RenderReport report;
        Picture shown;
        shown.image = render(shared_device(), scene, report);
        shown.launches = device.launches;
        shown.bytes = device.allocated_bytes;
        return shown;
    }
};

constexpr const char* kNextTo = R"({"kind": "ball", "center": [8, 9, 7], "radius": 1})";
constexpr const char* kAmid = R"({"kind": "ball", "center": [0, 0, 0], "radius": 0.9})";
constexpr const char* kBelow = R"({"kind": "height", "base": -900, "scale_height": 0.5})";

TEST_F(ClearMedium, IsNotMadeAndChangesNothing) {
    write_grid("zero.vdb", 0, 0, 0);
    write_grid("less.vdb", 0, -3, -1);
    for (const char* material : {"clay", "glass"}) {
        const Picture none = show(without_fog(material)), fog = show(foggy(kAmid, material));
        EXPECT_NE(fog.image.planes, none.image.planes);
        for (const char* density : {kNextTo, kBelow, R"({"kind": "grid", "file": "zero.vdb"})",
                                    R"({"kind": "grid", "file": "less.vdb"})"}) {
            const Scene scene = foggy(density, material);
            const Picture clear = show(scene);
            EXPECT_EQ(clear.image.planes, none.image.planes) << density;
            for (const char* kernel : {"absorb_sight"}) {
                EXPECT_TRUE(fog.launches.contains(kernel));
                EXPECT_FALSE(clear.launches.contains(kernel)) << density;
            }
            for (const char* buffer : {"medium densities", "medium bricks"}) {
                EXPECT_TRUE(fog.bytes.contains(buffer));
                EXPECT_FALSE(clear.bytes.contains(buffer)) << density;
            }
            AssetStore meshes;
            const ScenePlan plan = plan_scene(scene, meshes);
            EXPECT_EQ(plan.medium.bytes, 0) << density;
            EXPECT_EQ(plan.rays.maximum(),
                      plan_scene(without_fog(material), meshes).rays.maximum());
        }
    }
}

TEST_F(ClearMedium, IsTheSameVolumeAsNone) {
    for (const char* material : {"clay", "glass"}) {
        RenderReport report;
        const Volume none = render_volume(shared_device(), without_fog(material), report);
        const Volume clear = render_volume(shared_device(), foggy(kNextTo, material), report);
        ASSERT_FALSE(none.colors.empty());
        EXPECT_EQ(clear.indices, none.indices);
        EXPECT_EQ(clear.colors, none.colors);
        EXPECT_EQ(clear.opacities, none.opacities);
    }
}

TEST_F(ClearMedium, IsOneValueOrMoreAboveZeroNotClear) {
    write_grid("some.vdb", 0, 0.25f, 0);
    write_grid("around.vdb", 0, 0, 0.5f);
    for (const char* file : {"some.vdb", "around.vdb"})
        EXPECT_TRUE(show(foggy(fmt::format(R"({{"kind": "grid", "file": "{}"}})", file)))
                        .launches.contains("absorb_sight"))
            << file;
}

TEST_F(ClearMedium, MayComeIntoAWorldThatIsKept) {
    WorldBuilder builder(shared_device(), true);
    Renderer renderer(shared_device());
    for (const char* density : {kNextTo, kAmid, kNextTo}) {
        const Scene scene = foggy(density);
        RenderReport report;
        const BuiltWorld world = builder.build(scene, report.world);
        EXPECT_EQ(features_of(scene, world.pyramid).medium, density == kAmid);
        EXPECT_EQ(renderer.image(scene, world, report)->planes, show(scene).image.planes);
    }
}

}  // namespace
}  // namespace voxelume
