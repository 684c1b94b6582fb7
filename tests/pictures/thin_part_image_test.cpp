// SPDX-License-Identifier: Apache-2.0
// Pictures of meshes that are smooth except for thin parts, whose surfaces overlap those of the
// rest.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <initializer_list>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/world/world.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/finned_ball.hpp"
#include "tests/support/image_memory.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

class ThinPartImage : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "fin.obj", finned_ball(0.012, 0.6, 192));
    }

    /// The finned ball in a world of such voxels, with its surface chosen.
    Scene scene_of(double voxel, const char* placement, const char* surface = "auto",
                   const char* material = "", const char* more = "") const {
        AssetStore files;
        Scene scene = parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": {0}, "bounds": {{"min": [-0.8, -0.8, -0.8], "max": [0.8, 0.8, 0.8]}},
          "ambient": [0.3, 0.3, 0.3]}},
"models": {{"m": {{"mesh": "fin.obj", "voxel_size": {0}, "surface": "{2}"}}}},
"materials": {{"paint": {{{3}}}}},
"objects": [{{"name": "fin", "model": "m", "material": "paint", "turn": [14, 35, 5],
             "placement": "{1}"}}{4}],
"lights": [{{"type": "point", "position": [-3, 4, -4], "intensity": 30}}],
"observer": {{"position": [0.3, 0.6, -2.2], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 34}}}},
"render": {{"size": [160, 160]}}}})",
                                              voxel, placement, surface, material, more),
                                  folder / "fin.json", {}, [&](const Model& model, bool keeps) {
                                      return files.box_of_file(model, keeps);
                                  });
        AssetStore meshes;
        make_choices(scene, meshes);
        return scene;
    }

    /// The scene with the field of the ball and the triangles of the fin.
    Scene mixed_scene(double voxel, const char* placement, const char* more = "") const {
        Scene scene = scene_of(voxel, placement, "smooth", "", more);
        scene.models[0].thin_edge = voxel;
        return scene;
    }

    static Image picture(Scene scene) {
        scene.render.channels.depth = scene.render.channels.object = true;
        RenderReport report;
        return render(shared_device(), scene, report);
    }
};

/// True if a pixel's depth is within a voxel of those of its eight neighbours.
bool is_flat(const Image& image, size_t pixel, double voxel) {
    const auto& depth = image.planes.at("Z");
    for (size_t i = 0; i < 9; ++i) {
        const size_t neighbour =
            pixel + i % 3 + size_t(image.width) * (i / 3) - size_t(image.width) - 1;
        if (neighbour >= depth.size() || !(std::abs(depth[neighbour] - depth[pixel]) <= voxel))
            return false;
    }
    return true;
}

/// Expects pictures of one body. Every pixel of one picture shows the body where the other does,
/// except for `rim` pixels of outlines. Depths are equal to a tenth of a voxel, except for as many
/// pixels where rays graze the body and depths differ by more than a voxel from pixel to pixel.
void expect_alike(const Image& mixed, const Image& exact, double voxel, int rim) {
    const auto& a = mixed.planes.at("Z");
    const auto& b = exact.planes.at("Z");
    int lost = 0, off = 0, seen = 0;
    for (size_t i = 0; i < a.size(); ++i) {
        lost += std::isfinite(a[i]) != std::isfinite(b[i]);
        if (!std::isfinite(a[i]) || !std::isfinite(b[i])) continue;
        ++seen;
        const bool is_off = std::abs(a[i] - b[i]) > 0.1 * voxel;
        EXPECT_FALSE(is_off && is_flat(exact, i, voxel)) << "pixel " << i;
        off += is_off;
        EXPECT_LT(a[i] - b[i], 0.5 * voxel) << "a hole at " << i;
    }
    EXPECT_GT(seen, 6000);
    EXPECT_LE(lost, rim);
    EXPECT_LE(off, rim);
    const auto& ids = mixed.id_planes.at("objectId");
    const auto& other = exact.id_planes.at("objectId");
    int different = 0;
    for (size_t i = 0; i < ids.size(); ++i) different += ids[i] != other[i];
    EXPECT_EQ(different, lost) << "one object";
}

TEST_F(ThinPartImage, HasNoHolesWhereTheSurfacesMeet) {
    for (const double voxel : {1 / 38.0, 1 / 48.0, 1 / 110.0})
        for (const char* placement : {"world", "instance"}) {
            SCOPED_TRACE(fmt::format("{} in voxels of {} m", placement, voxel));
            expect_alike(picture(mixed_scene(voxel, placement)),
                         picture(scene_of(voxel, placement, "exact")), voxel, 10);
        }
}

/// The light of a pixel and its neighbours: the minimum and the maximum over several pictures.
struct LightAround {
    float min = 1e9f, max = 0;
};
LightAround light_around(std::initializer_list<const Image*> images, int x, int y, int width) {
    LightAround around;
    for (const Image* image : images)
        for (int i = 0; i < 9; ++i) {
            const float light =
                image->planes.at("G")[size_t(x + i % 3 - 1 + width * (y + i / 3 - 1))];
            around.min = std::min(around.min, light);
            around.max = std::max(around.max, light);
        }
    return around;
}

// A ray to the light that begins on the lower of the two surfaces leaves by the upper one's back.
TEST_F(ThinPartImage, HasNoSpecklesWhereTheSurfacesMeet) {
    for (const char* placement : {"world", "instance"}) {
        const auto large = [&](Scene scene) {
            scene.render.size = {320, 320};
            return picture(std::move(scene));
        };
        const Image mixed = large(mixed_scene(1 / 48.0, placement));
        const Image exact = large(scene_of(1 / 48.0, placement, "exact"));
        const Image smooth = large(scene_of(1 / 48.0, placement, "smooth"));
        int speckles = 0;
        for (int y = 1; y < 319; ++y)
            for (int x = 1; x < 319; ++x) {
                const float light = mixed.planes.at("G")[size_t(x + 320 * y)];
                const LightAround around = light_around({&exact, &smooth}, x, y, 320);
                speckles += light < around.min - 0.03f || light > around.max + 0.03f;
            }
        EXPECT_EQ(speckles, 0) << placement;
    }
}

TEST_F(ThinPartImage, HasTheSameBitsOnAnyNumberOfLanes) {
    for (const char* placement : {"world", "instance"}) {
        Scene scene = mixed_scene(1 / 38.0, placement);
        scene.materials[size_t(scene.objects[0].material)].reflection = 0.4f;
        scene.render.size = {48, 40};
        const auto hash_on = [&](const Device& device) {
            RenderReport report;
            return oracle::image_hash(render(device, scene, report));
        };
        const uint64_t expected = hash_on(shared_device());
        std::vector<int> others = {1, 4, 8, 16};
        std::erase(others, shared_device().lanes());
        for (const int lanes : in_turn(others, 1))
            EXPECT_EQ(hash_on(test_device(lanes)), expected) << lanes << " lanes, " << placement;
    }
}

TEST_F(ThinPartImage, ShowsWhatSmoothLoses) {
    const Image mixed = picture(mixed_scene(1 / 48.0, "world"));
    const Image lost = picture(scene_of(1 / 48.0, "world", "smooth"));
    int missing = 0;
    for (size_t i = 0; i < mixed.planes.at("Z").size(); ++i)
        missing += std::isfinite(mixed.planes.at("Z")[i]) && !std::isfinite(lost.planes.at("Z")[i]);
    EXPECT_GT(missing, 20);
}

TEST_F(ThinPartImage, OfSeveralObjectsKeepsThemApart) {
    const char* const second =
        R"(, {"name": "second", "model": "m", "material": "paint", "position": [0.2, 0.3, 0.35],
             "turn": [80, 10, 0]})";
    const auto mixed = picture(mixed_scene(1 / 48.0, "world", second)).id_planes.at("objectId");
    const auto exact =
        picture(scene_of(1 / 48.0, "world", "exact", "", second)).id_planes.at("objectId");
    int other = 0;
    for (size_t i = 0; i < mixed.size(); ++i) other += mixed[i] != exact[i];
    EXPECT_LE(other, 12);
}

TEST_F(ThinPartImage, IsTheSameFromTheCache) {
    const ModelCache cache = ModelCache(folder / "cache", 1 << 26, 0).with_worlds();
    const auto hash = [&](double voxel, const ModelCache& kept) {
        RenderReport report;
        const Scene scene = mixed_scene(voxel, "world");
        const BuiltWorld world =
            WorldBuilder(shared_device(), false, AssetStore(kept)).build(scene, report.world);
        return oracle::image_hash(Renderer(shared_device(), false).new_image(scene, world, report));
    };
    for (int run = 0; run < 2; ++run)
        for (const double voxel : {1 / 38.0, 1 / 48.0})
            EXPECT_EQ(hash(voxel, cache), hash(voxel, {})) << voxel << " in run " << run;
}

TEST_F(ThinPartImage, TakesTheMemoryThatIsPromised) {
    for (const char* placement : {"world", "instance"}) {
        const ImageMemoryUse use = memory_of_image(mixed_scene(1 / 110.0, placement));
        EXPECT_LE(use.min, use.fact) << placement;
        EXPECT_GE(use.promise, use.fact) << placement;
        EXPECT_LE(use.promise, 1.4 * use.fact) << placement;
    }
}

}  // namespace
}  // namespace voxelume
