// SPDX-License-Identifier: Apache-2.0
// lib/light/sky_map.h against bilinear interpolation and integrals over a picture in double
// precision, and the directions that it chooses against their density.
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "runtime/stages/features.hpp"
#include "runtime/stages/light/sky_map.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kSkySource = R"(
#include "lib/lanes/work_item.h"
#include "lib/light/sky_map.h"
kernel void look_at_sky(VXL_SKY_MAP_PARAMETERS uint count, uint stride, global const float* ways,
                        global float* values) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const SkyMap map = VXL_SKY_MAP_VIEW;
    const Vector way = load_vector(ways, stride, first);
    lane_float light[3];
    sky_map_light(&map, way, light);
    for (uint c = 0; c < 3; ++c) LANES_STORE(light[c], values, c * stride + first);
    LANES_STORE(sky_map_density(&map, way), values, 3u * stride + first);
}
kernel void choose_in_sky(VXL_SKY_MAP_PARAMETERS uint count, uint seed, global float* ways) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const SkyMap map = VXL_SKY_MAP_VIEW;
    const lane_uint number = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    lane_float density;
    store_vector(choose_sky_direction(&map, sobol_bits(number, (lane_uint)seed), &density), ways,
                 count, first);
    LANES_STORE(density, ways, 3u * count + first);
}
)";

/// A picture with a dark half, a bright spot and random colours elsewhere.
SkyMapData picture(int width, int height, bool is_black = false) {
    SkyMapData data;
    data.width = width, data.height = height;
    std::mt19937 random(5);
    std::uniform_real_distribution<float> any(0, 1);
    for (int y = 0; y < height; ++y)
        for (int x = 0; x < width; ++x)
            for (int c = 0; c < 3; ++c) {
                float value = x < width / 2 ? 0.0f : any(random);
                if (x == width / 5 && y == height / 3) value = 300.0f + float(c);
                data.texels.push_back(is_black ? 0.0f : value);
            }
    make_sky_cells(data);
    return data;
}

glm::dvec3 texel(const SkyMapData& data, int x, int y) {
    x = (x % data.width + data.width) % data.width;
    y = std::clamp(y, 0, data.height - 1);
    const float* t = &data.texels[size_t(y * data.width + x) * 3];
    return {t[0], t[1], t[2]};
}

/// The picture at a place of it, blended between the middles of texels.
glm::dvec3 blended(const SkyMapData& data, double u, double v) {
    const double x = u * data.width - 0.5, y = v * data.height - 0.5;
    const int column = int(std::floor(x)), row = int(std::floor(y));
    const double a = x - column, b = y - row;
    return (1 - b) * ((1 - a) * texel(data, column, row) + a * texel(data, column + 1, row)) +
           b * ((1 - a) * texel(data, column, row + 1) + a * texel(data, column + 1, row + 1));
}

/// The direction of a place; the middle is +Z, and +X lies left of it.
glm::dvec3 direction(double u, double v, double turn) {
    const double longitude = 2 * std::numbers::pi * (0.5 - u + turn);
    return {std::sin(longitude) * std::sin(std::numbers::pi * v), std::cos(std::numbers::pi * v),
            std::cos(longitude) * std::sin(std::numbers::pi * v)};
}

struct SkyMapTest : testing::Test {
    SkyMap on_device(const Device& device, const SkyMapData& data, double turn, float strength) {
        SkyMap map;
        map.is_used = true;
        map.record = {data.width,  data.height, data.columns, data.rows,
                      float(turn), strength,    1.0f,         0};
        map.texels = Buffer<float>(device, "texels", std::span(data.texels));
        map.table = Buffer<uint32_t>(device, "table", std::span(data.table));
        return map;
    }
    Program program(const Device& device) {
        Features features;
        features.sky = VXL_SKY_MAP;
        return Program::from_text(device, kSkySource, features.defines(device));
    }
    struct Seen {
        glm::dvec3 light;
        double density;
    };
    std::vector<Seen> look(const SkyMapData& data, const std::vector<glm::dvec3>& ways,
                           double turn = 0, int lanes = 0) {
        const Device device = test_device(lanes);
        const auto count = uint32_t(ways.size()), stride = (count + 15) / 16 * 16;
        std::vector<float> w(size_t(stride) * 3, 0.5f);
        for (uint32_t i = 0; i < count; ++i)
            for (uint32_t c = 0; c < 3; ++c) w[c * stride + i] = float(ways[i][int(c)]);
        Buffer<float> values(device, "values", size_t(stride) * 4);
        program(device)
            .kernel("look_at_sky")
            .launch_packets(count, on_device(device, data, turn, 2), count, stride,
                            Buffer<float>(device, "ways", std::span<const float>(w)), values);
        const std::vector<float> v = values.read();
        std::vector<Seen> seen(count);
        for (uint32_t i = 0; i < count; ++i)
            seen[i] = {{v[i], v[stride + i], v[2 * stride + i]}, v[3 * stride + i]};
        return seen;
    }
    std::vector<float> choose(const SkyMapData& data, uint32_t count, double turn = 0,
                              int lanes = 0) {
        const Device device = test_device(lanes);
        Buffer<float> ways(device, "ways", size_t(count) * 4);
        program(device)
            .kernel("choose_in_sky")
            .launch_packets(count, on_device(device, data, turn, 2), count, 77u, ways);
        return ways.read();
    }
};

TEST_F(SkyMapTest, ShowsThePictureBetweenTheMiddlesOfItsTexels) {
    for (const double turn : {0.0, 0.3}) {
        const SkyMapData data = picture(37, 19);
        std::mt19937 random(9);
        std::uniform_real_distribution<double> any(0, 1);
        std::vector<glm::dvec3> ways;
        std::vector<glm::dvec2> places;
        for (int i = 0; i < 4000; ++i) {
            places.emplace_back(any(random), any(random));
            ways.push_back(direction(places.back().x, places.back().y, turn));
        }
        const std::vector<Seen> seen = look(data, ways, turn);
        for (size_t i = 0; i < ways.size(); ++i)
            for (int c = 0; c < 3; ++c)
                // Near a pole a direction in floats is that of several places.
                ASSERT_NEAR(seen[i].light[c], 2 * blended(data, places[i].x, places[i].y)[c],
                            2e-3 / std::sin(std::numbers::pi * places[i].y))
                    << places[i].x << " " << places[i].y;
    }
}

TEST_F(SkyMapTest, TheAxesAreThoseOfAnObserverInside) {
    SkyMapData data = picture(8, 4, true);
    const auto mark = [&](int x, int y, float value) {
        data.texels[size_t(y * 8 + x) * 3 + 1] = value;
    };
    mark(3, 1, 1), mark(4, 1, 1), mark(3, 2, 1), mark(4, 2, 1);  // ahead: +Z
    mark(1, 1, 2), mark(2, 1, 2), mark(1, 2, 2), mark(2, 2, 2);  // left: +X
    const std::vector<Seen> seen = look(data, {{0, 0, 1}, {1, 0, 0}, {-1, 0, 0}, {0, 1, 0}});
    EXPECT_NEAR(seen[0].light.y, 2, 1e-5);
    EXPECT_NEAR(seen[1].light.y, 4, 1e-5);
    EXPECT_NEAR(seen[2].light.y, 0, 1e-5);
    EXPECT_NEAR(seen[3].light.y, 0, 1e-5);
    // Turned a quarter counterclockwise as seen from above, what was ahead is at +X.
    EXPECT_NEAR(look(data, {{1, 0, 0}}, 0.25)[0].light.y, 2, 1e-5);
}

TEST_F(SkyMapTest, CellsAreAsProbableAsTheirLight) {
    const SkyMapData data = picture(24, 12);
    // Integrals of the luminance by the middle rule, 16 x 16 points a texel.
    constexpr int kFine = 16;
    std::vector<double> light(size_t(24) * 12);
    double sum = 0;
    for (int y = 0; y < 12 * kFine; ++y)
        for (int x = 0; x < 24 * kFine; ++x) {
            const double v = (y + 0.5) / (12 * kFine);
            const double value =
                glm::dot(blended(data, (x + 0.5) / (24 * kFine), v), {0.2126, 0.7152, 0.0722}) *
                std::sin(std::numbers::pi * v);
            light[size_t(y / kFine * 24 + x / kFine)] += value;
            sum += value;
        }
    std::vector<glm::dvec3> middles;
    for (int y = 0; y < 12; ++y)
        for (int x = 0; x < 24; ++x)
            middles.push_back(direction((x + 0.5) / 24, (y + 0.5) / 12, 0));
    const std::vector<Seen> seen = look(data, middles);
    for (size_t i = 0; i < middles.size(); ++i) {
        const double sine = std::sin(std::numbers::pi * (double(i / 24) + 0.5) / 12);
        const double expected =
            light[i] / sum * 24 * 12 / (2 * std::numbers::pi * std::numbers::pi * sine);
        ASSERT_NEAR(seen[i].density, expected, 2e-3 * expected + 1e-8) << i;
    }
}

TEST_F(SkyMapTest, ChoosesDirectionsAsTheDensitySays) {
    constexpr uint32_t kCount = 1u << 17;
    for (const bool is_black : {false, true})
        for (const glm::ivec2 size : {glm::ivec2(24, 12), glm::ivec2(1, 1), glm::ivec2(5, 80)}) {
            const SkyMapData data = picture(size.x, size.y, is_black);
            const std::vector<float> ways = choose(data, kCount, 0.4);
            std::vector<glm::dvec3> some;
            constexpr int kRows = 10, kColumns = 15, kFine = 24;  // of whole cells
            std::vector<double> found(kRows * kColumns), expected(kRows * kColumns);
            for (size_t i = 0; i < kCount; ++i) {
                const glm::dvec3 w{ways[i], ways[kCount + i], ways[2 * kCount + i]};
                ASSERT_NEAR(glm::length(w), 1, 1e-6);
                const double turn = std::atan2(w.x, w.z) / (2 * std::numbers::pi) + 0.5;
                const int row = std::min(int(std::acos(w.y) / std::numbers::pi * kRows), kRows - 1);
                ++found[size_t(row * kColumns + std::min(int(turn * kColumns), kColumns - 1))];
                if (i % 64 == 0) some.push_back(w);
            }
            // The density that comes with a direction is the one that is looked up for it.
            const std::vector<Seen> seen = look(data, some, 0.4);
            int differing = 0;
            for (size_t k = 0; k < some.size(); ++k) {
                const double told = ways[3 * kCount + 64 * k];
                differing += std::abs(seen[k].density - told) > 1e-4 * told;
            }
            EXPECT_LE(differing, int(some.size() / 200)) << size.x;
            std::vector<glm::dvec3> grid;
            std::vector<double> angles;
            for (int y = 0; y < kRows * kFine; ++y)
                for (int x = 0; x < kColumns * kFine; ++x) {
                    const double theta = std::numbers::pi * (y + 0.5) / (kRows * kFine);
                    const double turn =
                        2 * std::numbers::pi * ((x + 0.5) / (kColumns * kFine) - 0.5);
                    grid.emplace_back(std::sin(turn) * std::sin(theta), std::cos(theta),
                                      std::cos(turn) * std::sin(theta));
                    angles.push_back(std::sin(theta));
                }
            const std::vector<Seen> densities = look(data, grid, 0.4);
            double all = 0;
            for (size_t k = 0; k < grid.size(); ++k) {
                const double share = densities[k].density * angles[k] * 2 * std::numbers::pi *
                                     std::numbers::pi / double(grid.size());
                const size_t y = k / (kColumns * kFine), x = k % (kColumns * kFine);
                expected[y / kFine * kColumns + x / kFine] += share * kCount;
                all += share;
            }
            EXPECT_NEAR(all, 1, 2e-3) << size.x;
            for (size_t k = 0; k < found.size(); ++k)
                EXPECT_NEAR(found[k], expected[k], 0.03 * expected[k] + 25) << size.x << " " << k;
        }
}

TEST_F(SkyMapTest, IsTheSameOnAnyNumberOfLanes) {
    const SkyMapData data = picture(37, 19);
    const std::vector<float> one = choose(data, 4096, 0.1, 1);
    for (const int lanes : in_turn<int>({4, 8, 16}, 1))
        EXPECT_EQ(choose(data, 4096, 0.1, lanes), one);
}

TEST(SkyCells, LeaveNoneOutAndCoverEverything) {
    for (const bool is_black : {false, true}) {
        const SkyMapData data = picture(4100, 3, is_black);
        ASSERT_EQ(data.columns, VXL_SKY_MAX_CELLS);
        ASSERT_EQ(data.rows, 3);
        EXPECT_EQ(data.table[0], 0u);
        for (int row = 0; row < 3; ++row) {
            const uint32_t* starts = &data.table[size_t(3 + row * data.columns)];
            EXPECT_EQ(starts[0], 0u);
            for (int i = 1; i < data.columns; ++i) ASSERT_GT(starts[i], starts[i - 1]) << i;
        }
    }
}

}  // namespace
}  // namespace voxelume
