// SPDX-License-Identifier: Apache-2.0
// Glass cubes of several objects and materials that touch: no gap lies between them.
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>

#include "tests/pictures/glass/refracted_rays.hpp"
#include "tests/pictures/glass_block.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/writers/vox_writer.hpp"

namespace voxelume::glass_block {
namespace {

/// The block of `kBlock` with other objects in it. A voxel shows the first object that has it.
std::string block_with(const std::string& others) {
    return others + kBlock;
}

/// A block like that of `kBlock`, moved so that it has a part of that one's voxels.
std::string moved_block(const std::string& material, const std::string& position) {
    return R"({"model": "block", "material": ")" + material + R"(", "position": )" + position +
           "}, ";
}

const std::string kAhead = "[2.0625, 0.0625, 0.0625]", kBelow = "[0.0625, -0.5625, 0.0625]";

/// The material "m" of a scene, and a second one, "n".
std::string materials(const std::string& m, const std::string& n) {
    return m + R"(, "n": )" + n;
}

constexpr const char* kGlass =
    R"({"diffuse": 0.125, "reflection": 1, "refraction": 0.875, "ior": 1.5, "fresnel": true,
        "absorption": [0.3, 0.1, 0.7]})";

/// The largest difference of two images' colours.
double difference(const Image& a, const Image& b) {
    double largest = 0;
    for (const char* color : kColors)
        for (size_t i = 0; i < a.planes.at(color).size(); ++i)
            largest = std::max(
                largest, std::abs(double(a.planes.at(color)[i]) - double(b.planes.at(color)[i])));
    return largest;
}

TEST(TouchingGlass, OfOneMaterialLooksLikeOneBlock) {
    for (const std::string& at : {kAhead, kBelow}) {
        const std::string joined = block_with(moved_block("m", at) + moved_block("m", at));
        const std::string apart = block_with(moved_block("n", at));
        for (const char* observer : {kFromAbove, R"("position": [4, 3, -5], "look_at": [0, 0, 0],
                             "display": {"shape": "pyramid", "angle": 25})"}) {
            const Image one =
                picture_of(block_scene(materials(kGlass, kGlass), -2, observer, joined));
            const Image two =
                picture_of(block_scene(materials(kGlass, kGlass), -2, observer, apart));
            EXPECT_LT(difference(one, two), 2e-6) << at << observer;
        }
    }
}

TEST(TouchingGlass, AbsorbsByTheMaterialThatTheLightIsIn) {
    const std::string m = R"({"diffuse": 0, "refraction": 1, "absorption": [0.25, 0, 0.5]})";
    const std::string n = R"({"diffuse": 0, "refraction": 1, "absorption": [0, 0.25, 0.5]})";
    const Image image = picture_of(
        block_scene(materials(m, n), -2, kThrough, block_with(moved_block("n", kAhead))));
    const auto voxels = [&](int c, double background) {
        return -std::log(image.planes.at(kColors[c])[0] / background) / 0.25 / 0.125;
    };
    const double in_m = voxels(0, 0.25), in_n = voxels(1, 0.5);
    EXPECT_NEAR(in_m, std::round(in_m), 1e-3);
    EXPECT_NEAR(in_m, 16, 1) << "the second block begins two metres behind the first one";
    EXPECT_NEAR(in_m + in_n, 39, 1e-3) << "from the first block to the end of the world";
    for (const float value : image.planes.at("B"))
        EXPECT_NEAR(value, 0.75 * std::exp(-0.5 * 39 * 0.125), 1e-6);
}

TEST(TouchingGlass, BendsLightFromOneIndexToTheOther) {
    // A gap of air would reflect all of this light, which arrives at 60 degrees or more.
    const std::string m = R"({"diffuse": 0, "refraction": 1, "ior": 1.5})";
    const std::string n = R"({"diffuse": 0, "refraction": 1, "ior": 1.6})";
    const std::string observer = R"("position": [-2.5, 0.5, 0], "look_at": [-1.875, 0.2, 0],
              "display": {"shape": "pyramid", "angle": 4})";
    const Scene scene = parse_scene(
        block_scene(materials(m, n), -20, observer, block_with(moved_block("n", kBelow))),
        "test.json", {});
    RefractedRays rays(scene, 192);
    rays.refract();  // in at the block's side
    std::vector<glm::dvec3> direction;
    for (uint32_t i = 0; i < 192; ++i) {
        ASSERT_TRUE(rays.is_hit(i)) << i;
        ASSERT_EQ(rays.normal(i), glm::dvec3(0, 1, 0)) << i;
        direction.push_back(rays.direction(i));
        ASSERT_GT(std::hypot(direction[i].x, direction[i].z) * 1.5, 1.0) << i;
    }
    rays.refract();
    for (uint32_t i = 0; i < 192; ++i) {
        glm::dvec3 bent = direction[i] * (1.5 / 1.6);
        bent.y = -std::sqrt(1 - bent.x * bent.x - bent.z * bent.z);
        EXPECT_LT(glm::distance(rays.direction(i), bent), 1e-5) << i;
        EXPECT_NE(rays.side(i) & VXL_SIDE_HIDDEN, 0u) << i;
    }
}

/// A scene of two touching blocks, and one of an exact box that fills the same space.
std::array<std::string, 2> blocks_and_box() {
    const std::string blocks = block_with(moved_block("n", kBelow));
    const std::string box = R"({"model": "box", "material": "m", "position": [0, -0.3125, 0]}, )";
    std::string with_box = block_scene(materials(kGlass, kGlass), -2, kFromAbove, box);
    const std::string models = R"("models": {)";
    with_box.insert(
        with_box.find(models) + models.size(),
        R"("box": {"shape": "box", "size": [3.75, 1.625, 2.75], "surface": "exact"}, )");
    return {block_scene(materials(kGlass, kGlass), -2, kFromAbove, blocks), with_box};
}

double mean_of(const Image& image, const char* color) {
    double sum = 0;
    for (const float value : image.planes.at(color)) sum += value;
    return sum / double(image.planes.at(color).size());
}

TEST(TouchingGlass, LooksLikeAnExactBox) {
    const auto [blocks, box] = blocks_and_box();
    EXPECT_LT(difference(picture_of(blocks), picture_of(box)), 1e-5);
}

TEST(TouchingGlass, LooksLikeAnExactBoxInGlobalLight) {
    std::array<std::string, 2> scenes = blocks_and_box();
    std::array<Image, 2> images;
    for (size_t i = 0; i < 2; ++i) {
        const std::string local = R"("shadow": "filtered")";
        scenes[i].replace(scenes[i].find(local), local.size(),
                          R"("light": "global", "samples": 512)");
        images[i] = picture_of(scenes[i]);
    }
    for (const char* color : kColors)
        EXPECT_NEAR(mean_of(images[0], color), mean_of(images[1], color), 3e-3) << color;
}

class TouchingGlassFile : public FileTest {
  protected:
    /// A file of a clear pane of palette entry 1 with a core of entry 2 in it, or the core alone.
    std::string file_of(const std::string& name, bool has_pane) {
        VoxWriter writer;
        std::vector<VoxWriter::Voxel> voxels;
        for (uint8_t x = 0; x < 16; ++x)
            for (uint8_t y = 0; y < 12; ++y)
                for (uint8_t z = 0; z < 9; ++z) {
                    const bool core = x > 4 && x < 9 && y > 2 && y < 8 && z > 3 && z < 6;
                    const bool corner = x == 15 && y == 11 && z == 8;
                    if (core || corner || has_pane)
                        voxels.push_back({x, y, z, uint8_t(core || corner ? 2 : 1)});
                }
        writer.model({16, 12, 9}, voxels);
        writer.material(1, {{"_type", "_glass"}, {"_weight", "1"}, {"_ior", "0.5"}});
        put_bytes(folder / name, writer.bytes());
        return R"({"voxelume": 1,
"world": {"voxel_size": 1, "bounds": {"min": [-9, -2, -9], "max": [11, 12, 9]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.1, 0.2, 0.3]},
"materials": {"core": {"color": [0.9, 0.5, 0.3]},
              "ghost": {"diffuse": 0, "refraction": 1, "ior": 1}},
"models": {"pane": {"voxels": ")" +
               name + R"("}},
"objects": [{"model": "pane", "material": "core"PARTS}],
"lights": [{"type": "point", "position": [3, 16, 22], "intensity": 300}],
"observer": {"position": [14, 13, 25], "look_at": [0, 4, 0],
             "display": {"shape": "pyramid", "angle": 40}},
"render": {"size": [16, 12], "shadow": "filtered"}})";
    }
};

TEST_F(TouchingGlassFile, ShowsAnotherMaterialOfItsObject) {
    std::string with = file_of("pane.vox", true), without = file_of("core.vox", false);
    const std::string parts = "PARTS";
    with.replace(with.find(parts), parts.size(), R"(, "materials": {"glass 1": "ghost"})");
    without.replace(without.find(parts), parts.size(), "");
    EXPECT_LT(
        difference(picture_of(with, 0, nullptr, folder), picture_of(without, 0, nullptr, folder)),
        1e-6);
}

}  // namespace
}  // namespace voxelume::glass_block
