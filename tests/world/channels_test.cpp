// SPDX-License-Identifier: Apache-2.0
// Channels that nobody needs are neither computed nor stored. The requested ones have the bits that
// they have in the image of all channels.
#include <gtest/gtest.h>

#include <algorithm>
#include <array>

#include "runtime/memory/plan.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// A scene of cubes, smooth and exact surfaces of glass, a mirror and a veil in a medium, with
/// shadows.
constexpr const char* kGlass = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -2], "max": [1, 1.2, 1.4]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.2, 0.3],
          "medium": {"absorption": [0.1, 0.2, 0.3]}},
"materials": {"clay": {"color": [0.8, 0.6, 0.4], "diffuse": 0.9, "specular": 0},
              "steel": {"diffuse": 0.2, "reflection": 0.5},
              "glass": {"diffuse": 0.1, "refraction": 0.8, "ior": 1.5, "fresnel": true,
                        "absorption": [1, 0.2, 0.5]},
              "veil": {"opacity": 0.5}},
"models": {"floor": {"shape": "box", "size": [1.8, 0.1, 2], "surface": "cubes"},
           "ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"},
           "solid": {"shape": "sphere", "radius": 0.25, "surface": "exact"},
           "block": {"shape": "box", "size": [0.4, 0.3, 0.5], "surface": "cubes"},
           "thing": {"mesh": "m.obj", "voxel_size": 0.05, "surface": "exact"}},
"objects": [{"model": "floor", "material": "clay", "position": [0, -0.8, 0]},
            {"model": "ball", "material": "glass", "position": [0.1, -0.2, 0.2]},
            {"model": "ball", "material": "steel", "position": [0.6, 0.3, 0.6]},
            {"model": "solid", "material": "glass", "position": [-0.4, 0.2, 0.5]},
            {"model": "block", "material": "glass", "position": [0.4, -0.5, -0.4]},
            {"model": "thing", "material": "veil", "position": [-0.7, -0.5, 0]}],
"lights": [{"type": "point", "position": [0.5, 3, -1], "intensity": 9}],
"observer": {"position": [0.2, 0.3, -1.7], "look_at": [0, -0.2, 0],
             "display": {"shape": "pyramid", "angle": 60, "voxels": [12, 9, 7]}},
"render": {"size": [48, 36], "depth": 3, "samples": 3, "shadow": "filtered"}})";

constexpr ImageChannels kColor{true, false, false, false, false};
constexpr ImageChannels kGeometry{false, true, true, true, true};

struct Picture {
    Image image;
    RenderReport report;
    std::map<std::string, uint64_t> launches, bytes;
};

class Channels : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "m.obj",
                  "v 0 0 0\nv 0.5 0 0\nv 0 0.5 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n");
    }

    Scene glass() const { return parse_scene(kGlass, folder / "s.json", {}); }

    static Picture show(Scene scene, const ImageChannels& channels) {
        scene.render.channels = channels;
        DeviceCounters& device = shared_device().counters();
        device.launches.clear();
        device.allocated_bytes.clear();
        Picture shown;
        shown.image = render(shared_device(), scene, shown.report);
        shown.launches = device.launches;
        shown.bytes = device.allocated_bytes;
        return shown;
    }
};

/// Expects that the channels that both images have are equal to the bit.
void expect_same(const Image& some, const Image& all) {
    for (const auto& [name, plane] : some.planes) EXPECT_EQ(plane, all.planes.at(name)) << name;
    for (const auto& [name, plane] : some.id_planes)
        EXPECT_EQ(plane, all.id_planes.at(name)) << name;
}

void expect_planes(const Picture& shown, const ImageChannels& asked) {
    const uint64_t planes =
        4u * asked.color + asked.depth + asked.distance + 3u * asked.position + 3u * asked.normal;
    const auto bytes = [&](const char* name) {
        return shown.bytes.contains(name) ? shown.bytes.at(name) : 0;
    };
    EXPECT_EQ(bytes("image"), planes * 48 * 36 * 4);
    EXPECT_EQ(bytes("object numbers"), asked.object ? 48u * 36 * 4 : 0u);
    EXPECT_EQ(shown.image.planes.size(), planes);
    EXPECT_EQ(shown.image.id_planes.size(), asked.object ? 1u : 0u);
}

TEST_F(Channels, NotAskedForAreNeitherMadeNorStored) {
    const Picture all = show(glass(), {.distance = true});
    for (int bits = 0; bits < 32; ++bits) {
        // By default, each pair of channels occurs together, separately, and not at all.
        constexpr std::array kCovering = {0, 3, 13, 21, 26, 30};
        if (!is_exhaustive() && !std::ranges::count(kCovering, bits)) continue;
        const ImageChannels asked{true,           bool(bits & 1), bool(bits & 2),
                                  bool(bits & 4), bool(bits & 8), bool(bits & 16)};
        const Picture shown = show(glass(), asked);
        expect_planes(shown, asked);
        expect_same(shown.image, all.image);
    }
    for (const ImageChannels& asked : {ImageChannels{false, true, false, false, false},
                                       ImageChannels{false, false, false, true, false},
                                       ImageChannels{false, false, false, false, true},
                                       ImageChannels{false, false, false, false, false, true}}) {
        const Picture shown = show(glass(), asked);
        expect_planes(shown, asked);
        expect_same(shown.image, all.image);
    }
}

TEST_F(Channels, WithoutColourNothingIsLit) {
    const Picture all = show(glass(), {});
    Picture some = show(glass(), kGeometry);
    expect_same(some.image, all.image);
    for (const char* kernel : {"add_light", "trace_shadows", "scatter_rays", "pass_layer",
                               "gather_light", "absorb_sight", "begin_paths", "trace_scattered"}) {
        EXPECT_TRUE(all.launches.contains(kernel)) << kernel;
        EXPECT_FALSE(some.launches.contains(kernel)) << kernel;
    }
    for (const char* buffer : {"radiance", "shadow queue", "shadow rays", "sides", "transmittance",
                               "coverage", "paths", "path media", "node light", "path counters"}) {
        EXPECT_GT(all.bytes.contains(buffer) ? all.bytes.at(buffer) : 0, 0u) << buffer;
        EXPECT_EQ(some.bytes[buffer], 0u) << buffer;
    }
    EXPECT_GT(all.report.shadow_rays, 0u);
    EXPECT_GT(all.report.secondary_rays, 0u);
    EXPECT_EQ(some.report.shadow_rays + some.report.secondary_rays, 0u);
}

TEST_F(Channels, WithoutColourEmissiveObjectsHaveNoLightSamples) {
    Scene scene = glass();
    scene.materials[1].emission = {3, 2, 1};
    EXPECT_TRUE(show(scene, {}).launches.contains("find_surface"));
    EXPECT_FALSE(show(scene, kGeometry).launches.contains("find_surface"));
}

TEST_F(Channels, AnObserverInsideOfGlassSeesTheSameWithoutColour) {
    const char* places[] = {"smooth", "solid", "cubes", "mesh"};
    const glm::dvec3 inside[] = {
        {0.1, -0.2, 0.2}, {-0.4, 0.2, 0.5}, {0.4, -0.5, -0.4}, {-0.62, -0.42, 0.1}};
    for (int i = 0; i < 4; ++i)
        for (const int depth : {0, 3}) {
            Scene scene = glass();
            scene.observer.position = inside[i];
            scene.render.depth = depth;
            const Picture all = show(scene, {});
            const Picture some = show(scene, kGeometry);
            expect_same(some.image, all.image);
            EXPECT_EQ(some.launches.contains("begin_paths"), i != 2) << "cubes know it without";
            EXPECT_FALSE(HasFailure()) << places[i] << ", depth " << depth;
        }
}

TEST_F(Channels, WithColourAloneTheRestOfUnlitPointsIsNotKept) {
    Scene scene = glass();
    for (Material& material : scene.materials) {
        material.opacity = 1;
        material.reflection = material.refraction = 0;
    }
    const Picture lit = show(scene, kColor);
    scene.lights.clear();
    const Picture all = show(scene, {});
    Picture some = show(scene, kColor);
    expect_same(some.image, all.image);
    for (const char* buffer : {"positions", "normals", "hit attributes"}) {
        EXPECT_TRUE(lit.bytes.contains(buffer)) << buffer;
        EXPECT_TRUE(all.bytes.contains(buffer)) << buffer;
        EXPECT_EQ(some.bytes[buffer], 0u) << buffer;
    }
}

TEST_F(Channels, DecideThePlanOfRaysAndPlanes) {
    for (const ImageChannels& asked : {ImageChannels{}, kColor, kGeometry}) {
        Scene scene = glass();
        scene.render.depth = 0;
        scene.render.channels = asked;
        AssetStore meshes;
        const ScenePlan plan = plan_scene(scene, meshes);
        const Picture shown = show(scene, asked);
        double rays = 0;
        for (const char* name :
             {"rays", "hits", "positions", "normals", "hit attributes", "radiance", "sides",
              "transmittance", "coverage", "paths", "path starts", "path media", "shadow queue",
              "node light", "node coverage", "path node weights", "path children",
              "path child weights"})
            if (shown.bytes.contains(name)) rays += double(shown.bytes.at(name));
        EXPECT_LE(plan.rays.minimum(), rays * 1.3) << asked.color << asked.depth;
        EXPECT_GE(plan.rays.maximum(), rays * 0.99) << asked.color << asked.depth;
    }
}

TEST_F(Channels, AreNotAVolumes) {
    Scene scene = glass();
    RenderReport report;
    const Volume all = render_volume(shared_device(), scene, report);
    scene.render.channels = {false, true, false, false, false};
    const Volume some = render_volume(shared_device(), scene, report);
    ASSERT_FALSE(all.colors.empty());
    EXPECT_EQ(some.colors, all.colors);
}

}  // namespace
}  // namespace voxelume
