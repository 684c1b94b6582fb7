// SPDX-License-Identifier: Apache-2.0
// The formats of displays, KV6, bit planes and cylinder buffers, read back by hand.
#include <gmock/gmock.h>

#include <cstring>
#include <nlohmann/json.hpp>
#include <set>

#include "runtime/io/volume/volume_dither.hpp"
#include "tests/io/little_endian.hpp"
#include "tests/io/volume/volume_damage.hpp"
#include "tests/support/volume_samples.hpp"

namespace voxelume {

namespace {

using Json = nlohmann::json;

uint32_t u16_at(const std::string& bytes, size_t at) {
    return uint32_t(uint8_t(bytes[at])) | uint32_t(uint8_t(bytes[at + 1])) << 8;
}

/// A box of opaque grey voxels from `first` to `last`, both included.
Volume solid_box(glm::ivec3 size, glm::ivec3 first, glm::ivec3 last, glm::vec3 color) {
    Volume volume = lattice_volume(size, 0);
    for (int z = first.z; z <= last.z; ++z)
        for (int y = first.y; y <= last.y; ++y)
            for (int x = first.x; x <= last.x; ++x) {
                volume.indices.push_back(uint64_t(x + size.x * (y + size.y * z)));
                volume.colors.push_back(color);
                volume.opacities.push_back(1);
                volume.depths.push_back(1);
                volume.objects.push_back(1);
                volume.kinds.push_back(VoxelKind::object);
            }
    return volume;
}

VolumeOptions device_options(Dither dither, SweepAxis sweep = SweepAxis::y) {
    VolumeOptions options;
    options.device.dither = dither;
    options.device.sweep = sweep;
    return options;
}

}  // namespace

class VolumeDeviceTest : public FileTest {
  protected:
    std::string write(const char* name, const Volume& volume, const VolumeOptions& options = {}) {
        write_volume(folder / name, volume, options);
        return bytes_of(folder / name);
    }
    Json header(const char* name) { return Json::parse(bytes_of(folder / name)); }
};

TEST_F(VolumeDeviceTest, BayersMatrixHasEveryThresholdOnce) {
    // The first rows of the classic dither matrix are 0 32 8 40 2 34 10 42 and 48 16 56 24 50 18 58
    // 26.
    const auto rank = [](int x, int y) {
        return threshold_at(Dither::bayer8, x, y, 0) * 64.0f - 0.5f;
    };
    const std::array<float, 8> first = {0, 32, 8, 40, 2, 34, 10, 42};
    const std::array<float, 8> second = {48, 16, 56, 24, 50, 18, 58, 26};
    for (int x = 0; x < 8; ++x) {
        EXPECT_EQ(rank(x, 0), first[size_t(x)]);
        EXPECT_EQ(rank(x, 1), second[size_t(x)]);
    }
    std::set<float> ranks;
    for (int i = 0; i < 64; ++i) ranks.insert(rank(i % 8, i / 8));
    EXPECT_EQ(ranks.size(), 64u);
    EXPECT_EQ(threshold_at(Dither::bayer8, 1, 2, 1), threshold_at(Dither::bayer8, 4, 7, 0));
    EXPECT_EQ(threshold_at(Dither::none, 1, 2, 3), 0.5f);
}

TEST_F(VolumeDeviceTest, LevelsKeepTheirMean) {
    for (const float value : {0.0f, 0.1f, 0.34f, 0.5f, 0.77f, 1.0f}) {
        double sum = 0;
        for (int i = 0; i < 64; ++i)
            sum += level_of(value, 7, threshold_at(Dither::bayer8, i % 8, i / 8, 0));
        EXPECT_NEAR(sum / 64 / 7, double(value), 0.5 / 64 / 7 + 1e-6);
    }
}

TEST_F(VolumeDeviceTest, Kv6HoldsTheSurfaceAsVoxlapReadsIt) {
    // The box has 3 x 4 x 5 voxels, 1 x 2 x 3 of them inside: x in 1..3, y in 0..3, z in 2..6.
    const Volume volume = solid_box({7, 5, 8}, {1, 0, 2}, {3, 3, 6}, {1, 0.5f, 0});
    const std::string bytes = write("a.kv6", volume);
    EXPECT_EQ(bytes.substr(0, 4), "Kvxl");
    EXPECT_EQ(u32_at(bytes, 4), 7u);
    EXPECT_EQ(u32_at(bytes, 8), 8u);
    EXPECT_EQ(u32_at(bytes, 12), 5u);
    const uint32_t count = u32_at(bytes, 28);
    EXPECT_EQ(count, 3u * 4 * 5 - 1u * 2 * 3);
    ASSERT_EQ(bytes.size(), 32u + 8 * count + 4 * 7 + 2 * 7 * 8);
    const size_t of_x = 32 + 8 * count, of_xy = of_x + 4 * 7;
    uint32_t sum = 0;
    size_t at = 32;
    for (uint32_t x = 0; x < 7; ++x) {
        uint32_t in_x = 0;
        for (uint32_t y = 0; y < 8; ++y) {
            const uint32_t in_xy = u16_at(bytes, of_xy + 2 * (x * 8 + y));
            in_x += in_xy;
            int before = -1;
            for (uint32_t n = 0; n < in_xy; ++n, at += 8) {
                const auto z = int(u16_at(bytes, at + 4));
                EXPECT_GT(z, before);
                before = z;
                // The lattice's x is 6 - x, its y is 7 - z and its z is 4 - y.
                const int faces = (x == 3) | (x == 5) << 1 | (y == 1) << 2 | (y == 5) << 3 |
                                  (z == 1) << 4 | (z == 4) << 5;
                EXPECT_EQ(uint8_t(bytes[at + 6]), faces) << x << " " << y << " " << z;
                EXPECT_EQ(u32_at(bytes, at), 0x80ffbc00u);
                EXPECT_NE(uint8_t(bytes[at + 7]), 255);
            }
        }
        EXPECT_EQ(u32_at(bytes, of_x + 4 * x), in_x);
        sum += in_x;
    }
    EXPECT_EQ(sum, count);
}

TEST_F(VolumeDeviceTest, Kv6NormalsPointOutwards) {
    // A slab covers the whole bottom; its top faces upwards, which is -z in KV6.
    const Volume volume = solid_box({9, 5, 8}, {0, 0, 0}, {8, 1, 7}, {1, 1, 1});
    const std::string bytes = write("a.kv6", volume);
    // The spiral's z grows evenly from -1; at the box's edges the normal leans outwards.
    int minimum = 255;
    for (size_t at = 32, n = 0; n < u32_at(bytes, 28); ++n, at += 8)
        if (uint8_t(bytes[at + 6]) == 0x10) {
            const int number = uint8_t(bytes[at + 7]);
            minimum = std::min(minimum, number);
            EXPECT_LT(number, 64);
        }
    EXPECT_LT(minimum, 4);
}

TEST_F(VolumeDeviceTest, PlanesLightTheRightBit) {
    const Volume volume = single_voxel({11, 5, 3}, {2, 4, 1}, {1, 1, 1});
    const struct {
        SweepAxis sweep;
        Json shape;
        int column, row, plane;
    } cases[] = {{SweepAxis::x, {3, 5, 11}, 1, 0, 8},
                 {SweepAxis::y, {11, 3, 5}, 8, 1, 4},
                 {SweepAxis::z, {11, 5, 3}, 8, 0, 1}};
    for (const auto& c : cases) {
        const std::string bytes = write("a.planes", volume, device_options(Dither::none, c.sweep));
        const Json json = header("a.planes.json");
        EXPECT_EQ(json["shape"], c.shape);
        const size_t row_bytes = json["row_bytes"], rows = json["shape"][1];
        ASSERT_EQ(bytes.size(), row_bytes * rows * json["shape"][2].get<size_t>());
        const size_t byte =
            (size_t(c.plane) * rows + size_t(c.row)) * row_bytes + size_t(c.column) / 8;
        for (size_t i = 0; i < bytes.size(); ++i)
            EXPECT_EQ(uint8_t(bytes[i]), i == byte ? 0x80 >> c.column % 8 : 0) << i;
    }
}

TEST_F(VolumeDeviceTest, ADitheredSolidHasItsShareOfBits) {
    for (const float grey : {0.25f, 0.5f, 0.8f}) {
        const Volume volume = solid_box({16, 8, 8}, {0, 0, 0}, {15, 7, 7}, glm::vec3(grey));
        const std::string bytes = write("a.planes", volume);
        int lit = 0;
        for (const char byte : bytes) lit += std::popcount(uint8_t(byte));
        EXPECT_NEAR(lit / 1024.0, double(grey), 0.5 / 64 + 1e-6);
    }
}

TEST_F(VolumeDeviceTest, ColourPlanesComeOneAfterAnother) {
    const Volume volume = single_voxel({11, 5, 3}, {10, 0, 2}, {1, 0, 1});
    const std::string bytes =
        write("a.cplanes", volume, device_options(Dither::none, SweepAxis::z));
    ASSERT_EQ(bytes.size(), 3u * 3 * 5 * 2);
    for (size_t i = 0; i < bytes.size(); ++i) {
        // Slice 2 uses planes 6 (red), 7 (green) and 8 (blue); the voxel is in the bottom row,
        // first column.
        const bool lit = i == (6 * 5 + 4) * 2 || i == (8 * 5 + 4) * 2;
        EXPECT_EQ(uint8_t(bytes[i]), lit ? 0x80 : 0) << i;
    }
    EXPECT_EQ(header("a.cplanes.json")["plane_colors"], Json({"red", "green", "blue"}));
}

TEST_F(VolumeDeviceTest, ACylinderHasItsAnglesRingsAndHeights) {
    Volume volume = solid_box({8, 3, 8}, {0, 0, 0}, {7, 2, 7}, {0, 0, 0});
    volume.frame.edge = {0.5, 0.25, 0.5};
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const int x = int(i % 8), y = int(i / 8 % 3), z = int(i / 24);
        // Red is at the image's right, -X_E; green is far, +Z_E; blue is at the top.
        volume.colors[i] = {x < 4 ? 1 : 0, z >= 4 ? 1 : 0, y == 2 ? 1 : 0};
    }
    VolumeOptions options = device_options(Dither::none);
    options.device.angles = 4;
    const std::string bytes = write("a.rgb332", volume, options);
    EXPECT_EQ(header("a.rgb332.json")["shape"], Json({3, 4, 4}));
    ASSERT_EQ(bytes.size(), 48u);
    const std::array<int, 4> quadrants = {0xfc, 0x1c, 0x00, 0xe0};
    for (size_t angle = 0; angle < 4; ++angle)
        for (size_t ring = 0; ring < 4; ++ring)
            for (size_t height = 0; height < 3; ++height)
                EXPECT_EQ(uint8_t(bytes[height + 3 * (ring + 4 * angle)]),
                          quadrants[angle] | (height == 2 ? 3 : 0));
    const std::string wide = write("a.rgb565", volume, options);
    ASSERT_EQ(wide.size(), 96u);
    EXPECT_EQ(u16_at(wide, 2 * 2), 0xffffu);
    EXPECT_EQ(u16_at(wide, 2 * (3 * 4 * 3)), 0xf800u);
}

TEST_F(VolumeDeviceTest, ACylinderHasAsManyAnglesAsItsRimNeeds) {
    const std::string bytes =
        write("a.rgb332", solid_box({9, 3, 8}, {0, 0, 0}, {8, 2, 7}, {1, 1, 1}));
    EXPECT_EQ(header("a.rgb332.json")["shape"], Json({3, 4, 26}));
    EXPECT_EQ(bytes, std::string(3 * 4 * 26, '\xff'));
}

}  // namespace voxelume
