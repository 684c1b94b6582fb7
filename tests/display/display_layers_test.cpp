// SPDX-License-Identifier: Apache-2.0
// Volumetric images by sight rays in scenes with surfaces that let light through: each surface is a
// voxel with its opacity, and the composited voxels are the flat image.
#include <gtest/gtest.h>

#include <algorithm>

#include "runtime/io/volume_file.hpp"
#include "tests/display/deep_file.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

/// A scene of two panes and a wall that only emit light, one behind the other along +Z, in a box
/// display with steps of half a metre. The panes are 0.25 m thick, so each has two surfaces.
constexpr const char* kPanes = R"({"voxelume": 1,
"world": {"voxel_size": 0.25, "bounds": {"min": [0, 0, 0], "max": [3, 2, 5]},
          "background": [0, 0, 0], "ambient": [0, 0, 0]%s},
"materials": {"first": {"color": [0, 0, 0], "emission": [0.4, 0.2, 0.1], "opacity": 0.25},
              "second": {"color": [0, 0, 0], "emission": [0.1, 0.6, 0.3], "opacity": 0.5},
              "wall": {"color": [0, 0, 0], "emission": [0.2, 0.3, 0.8]}},
"models": {"pane": {"shape": "box", "size": [2, 2, 0.25], "surface": "exact"},
           "wall": {"shape": "box", "size": [3, 2, 1], "surface": "exact"}},
"objects": [{"name": "first", "model": "pane", "material": "first", "position": [1, 1, 1.125]},
            {"name": "second", "model": "pane", "material": "second", "position": [2, 1, 2.375]},
            {"name": "wall", "model": "wall", "material": "wall", "position": [1.5, 1, 4.25]}],
"lights": [],
"observer": {"position": [1.5, 1, -1],
             "display": {"shape": "box", "size": [3, 2, 5], "near": 1, "voxels": [6, 4, 10]}},
"render": {"size": [6, 4]}})";

std::string panes(const std::string& world) {
    std::string text = kPanes;
    return text.replace(text.find("%s"), 2, world);
}

struct Seen {
    float color[3], opacity, depth;
    uint32_t object;
};

/// The voxels of one ray by their step.
std::map<int, Seen> column_of(const Volume& volume, int u, int v) {
    std::map<int, Seen> column;
    const glm::ivec3& size = volume.frame.size;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const auto pixel = volume.indices[i] % uint64_t(size.x * size.y);
        if (pixel != uint64_t(u + size.x * v)) continue;
        const glm::vec3& c = volume.colors[i];
        column[int(volume.indices[i] / uint64_t(size.x * size.y))] = {
            {c.r, c.g, c.b}, volume.opacities[i], volume.depths[i], volume.objects[i]};
    }
    return column;
}

TEST(Layers, EverySurfaceIsAVoxelWithItsOpacity) {
    const Volume volume = volume_of(parsed(panes("")));
    // Column u = 0 is the image's left, x = 2.75: the ray meets only the second pane, whose
    // surfaces at 2.25 and 2.5 lie in steps 4 and 5, and the wall at 3.75 in step 7.
    const auto left = column_of(volume, 0, 1);
    ASSERT_EQ(left.size(), 3u);
    for (const auto& [k, depth] : {std::pair{4, 3.25f}, {5, 3.5f}}) {
        const Seen& pane = left.at(k);
        EXPECT_EQ(pane.object, 2u);
        EXPECT_NEAR(pane.opacity, 0.5f, 1e-6f);
        EXPECT_NEAR(pane.depth, depth, 1e-5f);
        EXPECT_NEAR(pane.color[1], 0.6f, 1e-6f);
    }
    EXPECT_EQ(left.at(7).object, 3u);
    EXPECT_EQ(left.at(7).opacity, 1.0f);
    EXPECT_NEAR(left.at(7).color[2], 0.8f, 1e-6f);
    // Column u = 3 is x = 1.25: the first pane's surfaces at 1 and 1.25 share step 2.
    const auto both = column_of(volume, 3, 1);
    ASSERT_EQ(both.size(), 4u);
    EXPECT_EQ(both.at(2).object, 1u);
    EXPECT_NEAR(both.at(2).opacity, 1 - 0.75f * 0.75f, 1e-6f);
    EXPECT_NEAR(both.at(2).depth, 2.0f, 1e-5f);
    EXPECT_NEAR(both.at(2).color[0], 0.4f, 1e-6f);
    EXPECT_NEAR(both.at(4).color[1], 0.6f, 1e-5f);
    EXPECT_NEAR(both.at(7).color[0], 0.2f, 1e-5f);
}

TEST(Layers, TheMediumGoesOnBehindTransparentSurfaces) {
    const Volume volume = volume_of(
        parsed(panes(R"(, "medium": {"absorption": [0.3, 0.3, 0.3], "color": [0.1, 0.2, 0.3]})")));
    const auto both = column_of(volume, 3, 2);
    ASSERT_EQ(both.size(), 8u);  // steps 0 to 7
    for (const int k : {0, 1, 3, 6}) {
        const Seen& space = both.at(k);
        EXPECT_EQ(space.object, 0u);
        EXPECT_NEAR(space.opacity, 1 - std::exp(-0.3 * 0.5), 1e-6) << k;
        EXPECT_NEAR(space.color[2], 0.3f, 2e-6f) << k;
        EXPECT_NEAR(space.depth, 1 + 0.5 * k + 0.25, 1e-6) << k;
    }
    EXPECT_EQ(both.at(7).object, 3u);
    // The ray passes a quarter of a metre of space in front of the wall.
    const double before = std::exp(-0.3 * 0.25);
    EXPECT_NEAR(both.at(7).color[2], 0.8 * before + 0.3 * (1 - before), 1e-5);
}

constexpr const char* kPointLight =
    R"({"type": "point", "position": [-1, 2, -1.5], "intensity": 6})";

/// The scene of the fixture's ball and block; the ball's material lets light through.
Scene clear_scene(const std::string& keys, const std::string& world, const std::string& material) {
    std::string text = display_scene(keys, "smooth", world, kPointLight);
    const std::string red = R"("red": {"color": [0.8, 0.3, 0.2])";
    text.insert(text.find(red) + red.size(), material);
    return parsed(text);
}

/// The largest difference in colour between the flat image and the composited volume, and the
/// largest difference between the rays' coverage and A.
std::pair<double, double> difference(Scene scene, const Volume& volume, bool everywhere) {
    const glm::ivec3& size = volume.frame.size;
    const size_t pixels = size_t(size.x) * size_t(size.y);
    const std::vector<glm::dvec3> flat = flattened(volume, glm::dvec3(scene.world.background));
    std::vector<double> transmittance(pixels, 1);
    for (size_t i = 0; i < volume.indices.size(); ++i)
        transmittance[volume.indices[i] % pixels] *= 1 - double(volume.opacities[i]);
    resize(scene, {size.x, size.y});
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    double color = 0, coverage = 0;
    for (size_t i = 0; i < pixels; ++i) {
        const double a = double(image.planes.at("A")[i]);
        if (!everywhere && a < 1) continue;
        coverage = std::max(coverage, std::abs(1 - transmittance[i] - a));
        for (int c = 0; c < 3; ++c) {
            const double found = double(image.planes.at(std::string(1, "RGB"[c]))[i]);
            color = std::max(color, std::abs(flat[i][c] - found));
        }
    }
    return {color, coverage};
}

constexpr const char* kGrey =
    R"(, "medium": {"absorption": [0.4, 0.4, 0.4], "color": [0.3, 0.2, 0.1]})";

TEST(Layers, LaidOverOneAnotherAreTheFlatImageInEveryShape) {
    for (const DisplayCase& shape : kDisplayCases) {
        const Scene scene =
            clear_scene(std::string(shape.keys) + R"(, "voxels": [48, 36, 60])", kGrey,
                        R"(, "opacity": 0.6, "reflection": 0.4, "specular": 0.5)");
        const auto [color, coverage] = difference(scene, volume_of(scene), true);
        EXPECT_LT(color, 1e-5) << shape.name;
    }
}

TEST(Layers, LaidOverOneAnotherAreTheFlatImageOfEveryMaterial) {
    const std::string keys = std::string(kDisplayCases[0].keys) + R"(, "voxels": [48, 36, 60])";
    const Scene clear = clear_scene(keys, "", R"(, "opacity": 0.3)");
    const auto [color, coverage] = difference(clear, volume_of(clear), true);
    EXPECT_LT(color, 1e-5);
    EXPECT_LT(coverage, 1e-5);
    const Scene tinted = clear_scene(
        keys, R"(, "medium": {"absorption": [0.2, 0.6, 1.1], "color": [0.3, 0.2, 0.1]})",
        R"(, "opacity": 0.3, "absorption": [0.1, 0.9, 0.4])");
    EXPECT_LT(difference(tinted, volume_of(tinted), false).first, 1e-5);
    const Scene glass = clear_scene(
        keys, "", R"(, "diffuse": 0.1, "reflection": 0.1, "refraction": 0.9, "ior": 1.5)");
    EXPECT_LT(difference(glass, volume_of(glass), true).first, 1e-5);
}

TEST(Layers, AMediumOfVaryingDensityIsShownByVoxels) {
    const Volume volume = volume_of(
        parsed(panes(R"(, "medium": {"absorption": [0.3, 0.3, 0.3], "color": [0.1, 0.2, 0.3],
                        "density": {"kind": "height", "base": 1, "scale_height": 0.5}})")));
    // Above the base the density falls as e^(-(y - 1) / 0.5), sampled at the voxels' middles.
    for (const auto& [v, y] : {std::pair{0, 1.75}, {1, 1.25}, {2, 0.75}}) {
        const auto column = column_of(volume, 3, v);
        ASSERT_EQ(column.size(), 8u) << v;
        // Rays through pixels' middles lie between two rows of voxels of 0.25 m and may sample
        // either.
        double minimum = 1e9, maximum = 0;
        for (const double side : {-0.125, 0.125}) {
            const double density = y + side < 1 ? 1.0 : std::exp(-(y + side - 1) / 0.5);
            minimum = std::min(minimum, density), maximum = std::max(maximum, density);
        }
        for (const int k : {0, 1, 3, 6}) {
            const double density = -std::log1p(-double(column.at(k).opacity)) / 0.15;
            EXPECT_GT(density, minimum - 1e-5) << v << " " << k;
            EXPECT_LT(density, maximum + 1e-5) << v << " " << k;
            EXPECT_NEAR(column.at(k).color[1], 0.2f, 1e-5f);
        }
    }
}

TEST(Layers, LaidOverOneAnotherAreTheFlatImageInFog) {
    for (const DisplayCase& shape : kDisplayCases)
        for (const char* material : {"", R"(, "opacity": 0.3)"}) {
            const Scene scene =
                clear_scene(std::string(shape.keys) + R"(, "voxels": [48, 36, 60])",
                            R"(, "medium": {"absorption": [0.9, 0.9, 0.9], "color": [0.3, 0.2, 0.1],
                    "density": {"kind": "height", "base": -0.4, "scale_height": 0.5}})",
                            material);
            EXPECT_LT(difference(scene, volume_of(scene), true).first, 1e-5) << shape.name;
        }
}

TEST(Layers, ALatticeShowsWhatIsSeenThroughPanes) {
    Scene scene = parsed(panes(""));
    scene.observer.display.layout = VolumeLayout::lattice;
    for (const Visibility visibility : {Visibility::observer, Visibility::all}) {
        scene.observer.display.visibility = visibility;
        const Volume volume = volume_of(scene);
        std::map<uint32_t, int> counts;
        std::map<uint32_t, std::array<double, 24>> clear;  // of objects' columns along the view
        for (const uint32_t object : {1u, 2u}) clear[object].fill(1);
        for (size_t i = 0; i < volume.indices.size(); ++i) {
            const uint32_t object = volume.objects[i];
            ASSERT_TRUE(object >= 1 && object <= 3);
            ++counts[object];
            if (object == 3)
                EXPECT_EQ(volume.opacities[i], 1.0f);
            else
                clear[object][volume.indices[i] % 24] *= 1 - double(volume.opacities[i]);
            constexpr std::array kGreen = {0.2f, 0.6f, 0.3f};
            EXPECT_NEAR(volume.colors[i].g, kGreen[object - 1], 1e-5) << i;
        }
        // The front of the wall is 6 x 4 voxels behind one or two panes.
        EXPECT_GE(counts[3], 24) << int(visibility);
        EXPECT_GE(counts[1], 16);
        EXPECT_GE(counts[2], 16);
        // Both surfaces of a pane cover what is behind them, wherever its voxels are.
        for (size_t column = 0; column < 24; ++column) {
            const size_t x = column % 6;
            EXPECT_NEAR(clear[1][column], x < 4 ? 0.75 * 0.75 : 1, 1e-6) << column;
            EXPECT_NEAR(clear[2][column], x >= 2 ? 0.5 * 0.5 : 1, 1e-6) << column;
        }
    }
}

TEST(Layers, HaveTheSameBitsForEveryNumberOfLanes) {
    const Scene scene =
        clear_scene(std::string(kDisplayCases[0].keys) + R"(, "voxels": [40, 30, 36])",
                    R"(, "medium": {"absorption": [0.3, 1, 2], "color": [0.4, 0.2, 0.6]})",
                    R"(, "opacity": 0.3)");
    const Volume expected = volume_of(scene, 16);
    for (const int lanes : in_turn<int>({1, 8}, 1)) {
        const Volume volume = volume_of(scene, lanes);
        EXPECT_EQ(volume.indices, expected.indices) << lanes;
        EXPECT_EQ(volume.colors, expected.colors) << lanes;
        EXPECT_EQ(volume.opacities, expected.opacities) << lanes;
        EXPECT_EQ(volume.depths, expected.depths) << lanes;
        EXPECT_EQ(volume.objects, expected.objects) << lanes;
    }
}

class DeepImage : public FileTest {};

TEST_F(DeepImage, FlattenedByOpenExrIsTheFlatImageOfTheSameObserver) {
    const std::string keys = std::string(kDisplayCases[0].keys) + R"(, "voxels": [64, 48, 100])";
    for (const auto& [world, material] :
         {std::pair{"", ""}, std::pair{kGrey, R"(, "opacity": 0.3)"}}) {
        Scene scene = clear_scene(keys, world, material);
        write_volume(folder / "a.exr", volume_of(scene));
        const auto deep = flattened_file(folder / "a.exr", 64, 48);
        resize(scene, {64, 48});
        RenderReport report;
        const Image image = render(test_device(), scene, report);
        for (size_t p = 0; p < deep.size(); ++p)
            for (int c = 0; c < 3; ++c)
                ASSERT_NEAR(deep[p][c] + (1 - deep[p].a) * double(scene.world.background[c]),
                            image.planes.at(std::string(1, "RGB"[c]))[p], 1e-5)
                    << material << " " << p;
    }
}

}  // namespace
}  // namespace voxelume
