// SPDX-License-Identifier: Apache-2.0
// Textures in voxels' colours, against bilinear values in double.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>
#include <memory>

#include "runtime/stages/voxelize/voxelize_textures.hpp"
#include "tests/support/voxelize_fixture.hpp"

namespace voxelume {
namespace {

using glm::dvec2;
using glm::dvec3;
using glm::ivec3;

constexpr ivec3 kSize(40, 24, 5);

double linear(double code) {
    const double s = code / 255;
    return s <= 0.04045 ? s / 12.92 : std::pow((s + 0.055) / 1.055, 2.4);
}

double code_of(double value) {
    return 255 * (value <= 0.0031308 ? 12.92 * value : 1.055 * std::pow(value, 1 / 2.4) - 0.055);
}

/// An image of 7 x 5 texels with three different channels, and levels that nobody may mistake for
/// it.
TextureImage image_of(int width, int height) {
    TextureImage image{width, height, {}};
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            image.texels.push_back(uint32_t(x * 37 % 256) | uint32_t(y * 61 % 256) << 8 |
                                   uint32_t((x * 101 + y * 13) % 256) << 16 | 0xFF000000u);
    while (image.texels.size() < texel_count(image)) image.texels.push_back(0xFFFFFFFFu);
    return image;
}

/// The texel for a number, by the plain meaning of the three wraps.
int wrapped(int at, int size, TextureWrap wrap) {
    if (wrap == TextureWrap::clamp) return std::clamp(at, 0, size - 1);
    if (wrap == TextureWrap::repeat) return (at % size + size) % size;
    const int in_pair = (at % (2 * size) + 2 * size) % (2 * size);
    return in_pair < size ? in_pair : 2 * size - 1 - in_pair;
}

dvec3 bilinear(const Texture& texture, const dvec2& uv) {
    const TextureImage& image = *texture.image;
    const dvec2 at = uv * dvec2(image.width, image.height) - 0.5;
    dvec3 sum(0);
    for (int i = 0; i < 4; ++i) {
        const dvec2 corner = glm::floor(at) + dvec2(i & 1, i >> 1);
        const dvec2 weight = 1.0 - glm::abs(at - corner);
        const int x = wrapped(int(corner.x), image.width, texture.wrap_u);
        const int y = wrapped(int(corner.y), image.height, texture.wrap_v);
        const uint32_t texel = image.texels[size_t(y * image.width + x)];
        sum += weight.x * weight.y *
               dvec3(linear(texel & 255), linear(texel >> 8 & 255), linear(texel >> 16 & 255));
    }
    return sum;
}

/// A rectangle in the plane z = 2.5 from (1, 1) to (39, 23), whose places go from `low` to `high`.
Mesh wearing(const Texture& texture, const dvec2& low, const dvec2& high) {
    Mesh mesh;
    mesh.positions = {{1, 1, 2.5f}, {39, 1, 2.5f}, {39, 23, 2.5f}, {1, 23, 2.5f}};
    mesh.triangles = {{0, 1, 2}, {0, 2, 3}};
    mesh.uvs = {{low.x, low.y}, {high.x, low.y}, {high.x, high.y}, {low.x, high.y}};
    mesh.textures = {texture};
    mesh.group_textures = {0};
    return mesh;
}

std::vector<uint32_t> colors_of(const Mesh& mesh, Surface kind = Surface::cubes) {
    VoxelizeOptions options;
    options.surface = kind;
    const BrickGrid grid =
        shared_voxelizer().voxelize(mesh, glm::dmat4(1), unit_frame(kSize), options);
    const std::vector<uint32_t> slots = grid.slots.read(), colors = grid.colors.read();
    std::vector<uint32_t> found;
    for (int y = 1; y < 23; ++y)
        for (int x = 1; x < 39; ++x) {
            const GridSlot at = slot_in(grid, slots, {x, y, 2});
            found.push_back(colors.at(size_t(at.slot) * 4096 + at.number));
        }
    return found;
}

}  // namespace

TEST(Textures, AreBilinearInLinearLightWhateverLiesNextToThem) {
    const auto image = std::make_shared<const TextureImage>(image_of(7, 5));
    using enum TextureWrap;
    for (const auto& [u, v] : {std::pair{repeat, clamp}, {mirror, repeat}, {clamp, mirror}})
        for (const auto& [low, high] : {std::pair{dvec2(0, 0), dvec2(1, 1)},
                                        {dvec2(-1.3, 2.1), dvec2(2.2, -0.7)},
                                        {dvec2(100.25, -50.5), dvec2(99.5, -49.75)}}) {
            const Texture texture{image, u, v};
            const std::vector<uint32_t> colors = colors_of(wearing(texture, low, high));
            double largest = 0;
            for (size_t i = 0; i < colors.size(); ++i) {
                const dvec2 part((double(i % 38) + 0.5) / 38, (double(i / 38) + 0.5) / 22);
                const dvec3 expected = bilinear(texture, low + part * (high - low));
                for (int c = 0; c < 3; ++c)
                    largest = std::max(
                        largest, std::abs(double(colors[i] >> 8 * c & 255) - code_of(expected[c])));
            }
            // Half a code by rounding, and what a float of a place of 100 texture widths loses.
            EXPECT_LT(largest, 0.51 + (std::abs(low.x) > 50 ? 0.1 : 0))
                << int(u) << int(v) << " " << low.x;
        }
}

TEST(Textures, MultiplyTheColorsOfVerticesAndLeaveOtherTrianglesAlone) {
    TextureImage half{1, 1, {0xFFBCBCBCu}};  // linear 0.5029
    Mesh mesh = wearing({std::make_shared<const TextureImage>(half)}, {0, 0}, {1, 1});
    mesh.vertex_colors.assign(4, glm::vec3(1, 0.5f, 0));
    EXPECT_THAT(colors_of(mesh), testing::Each(0x0089BCu));
    mesh.triangle_group = {0, 1};
    mesh.group_textures = {0, kNoTexture};
    const std::vector<uint32_t> colors = colors_of(mesh);
    EXPECT_EQ(colors[30], 0x0089BCu);
    EXPECT_EQ(colors[38 * 20 + 2], 0x00BCFFu);
    mesh.triangle_group.clear();
    mesh.triangle_uvs = {{0, kNoUv, 2}, {0, 1, 2}};
    EXPECT_EQ(colors_of(mesh)[30], 0x00BCFFu) << "a corner has no place";
    EXPECT_EQ(colors_of(mesh)[38 * 20 + 2], 0x0089BCu);
}

TEST(Textures, OfSmallerTexelsThanVoxelsShowAFartherLevel) {
    TextureImage image = image_of(64, 64);
    for (size_t i = 0; i < 64 * 64; ++i) image.texels[i] = i % 2 ? 0xFFFFFFFFu : 0xFF000000u;
    size_t at = 64 * 64;
    for (const auto& [texels, color] :
         {std::pair{32 * 32, 0xFF0000FFu}, {16 * 16, 0xFF00FF00u}, {8 * 8, 0xFFFF0000u}})
        for (int i = 0; i < texels; ++i) image.texels[at++] = color;
    const auto shared = std::make_shared<const TextureImage>(image);
    // 38 x 22 voxels show 64 x 64 texels: 4.9 each, so the level of half as many along an axis.
    EXPECT_THAT(colors_of(wearing({shared}, {0, 0}, {1, 1})), testing::Each(0x0000FFu));
    EXPECT_THAT(colors_of(wearing({shared}, {0, 0}, {2, 2})), testing::Each(0x00FF00u));
    EXPECT_THAT(colors_of(wearing({shared}, {0, 0}, {4, 4})), testing::Each(0xFF0000u));
}

TEST(Textures, LevelsHaveTexelsOfTheSizeOfVoxels) {
    EXPECT_EQ(texture_level(1, 1, 8), 0u);
    EXPECT_EQ(texture_level(2, 1, 8), 0u);
    EXPECT_EQ(texture_level(2.1, 1, 8), 1u);
    EXPECT_EQ(texture_level(8.1, 1, 8), 2u);
    EXPECT_EQ(texture_level(1e30, 1, 8), 7u);
    EXPECT_EQ(texture_level(5, 0, 3), 2u);
    EXPECT_EQ(texture_level(0, 0, 3), 0u);
}

TEST(Textures, AreTheSameForEveryNumberOfLanesAndSurface) {
    const Texture texture{std::make_shared<const TextureImage>(image_of(7, 5))};
    const Mesh mesh = wearing(texture, {-0.2, 0.1}, {1.4, 0.8});
    const std::vector<uint32_t> colors = colors_of(mesh);
    EXPECT_EQ(colors_of(mesh, Surface::exact), colors);
    for (const int lanes : {16, 4, 1}) {
        Voxelizer voxelizer(test_device(lanes));
        VoxelizeOptions options;
        options.surface = Surface::exact;
        const BrickGrid grid = voxelizer.voxelize(mesh, glm::dmat4(1), unit_frame(kSize), options);
        const std::vector<uint32_t> slots = grid.slots.read(), words = grid.colors.read();
        const GridSlot at = slot_in(grid, slots, {12, 9, 2});
        EXPECT_EQ(words.at(size_t(at.slot) * 4096 + at.number), colors[8 * 38 + 11]);
    }
}

}  // namespace voxelume
