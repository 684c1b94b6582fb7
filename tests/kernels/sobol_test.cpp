// SPDX-License-Identifier: Apache-2.0
// lib/sampling/sobol.h against Sobol's and Owen's definitions, bit by bit on the host.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>
#include <set>

#include "runtime/opencl/program.hpp"
#include "tests/kernels/owen_points.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kSource = R"(
#include "lib/sampling/sobol.h"
#include "lib/lanes/work_item.h"
kernel void sample_square(uint count, global const uint* samples, global const uint* seeds,
                          uint stride, global float* points) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const SquarePoint p = sobol_point(LANES_LOAD(samples, first), LANES_LOAD(seeds, first));
    LANES_STORE(p.x, points, first);
    LANES_STORE(p.y, points, stride + first);
}
kernel void number_parts(uint count, global const uint* fractions, uint parts,
                         global uint* numbers) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    LANES_STORE(part_of(LANES_LOAD(fractions, first), parts), numbers, first);
}
)";

/// The points of the device for samples 0 .. count-1 of each seed, seed after seed.
std::vector<SquarePoint> points_of(uint32_t count, const std::vector<uint32_t>& seeds,
                                   int lanes = 0) {
    const Device device = test_device(lanes);
    std::vector<uint32_t> samples, all_seeds;
    for (const uint32_t seed : seeds)
        for (uint32_t i = 0; i < count; ++i) samples.push_back(i), all_seeds.push_back(seed);
    const auto all = uint32_t(samples.size()), stride = (all + 15) / 16 * 16;
    samples.resize(stride), all_seeds.resize(stride);
    Buffer<float> points(device, "points", size_t(stride) * 2);
    Program::from_text(device, kSource, {})
        .kernel("sample_square")
        .launch_packets(all, all,
                        Buffer<uint32_t>(device, "samples", std::span<const uint32_t>(samples)),
                        Buffer<uint32_t>(device, "seeds", std::span<const uint32_t>(all_seeds)),
                        stride, points);
    const std::vector<float> values = points.read();
    std::vector<SquarePoint> result;
    for (uint32_t i = 0; i < all; ++i) result.push_back({values[i], values[stride + i]});
    return result;
}

SquarePoint defined_point(uint32_t sample, uint32_t seed) {
    const auto [x, y] = sobol(value_of(scrambled(bits_of(sample), seed)));
    return owen_point(x, y, seed);
}

std::vector<uint32_t> random_seeds(size_t count) {
    std::mt19937 random(20251123);
    std::vector<uint32_t> seeds(count);
    for (uint32_t& seed : seeds) seed = uint32_t(random());
    return seeds;
}

TEST(Sobol, FirstPointsWithoutScramblingAreThoseOfTheTables) {
    EXPECT_EQ(sobol(1), (std::array<uint32_t, 2>{1u << 31, 1u << 31}));
    EXPECT_EQ(sobol(2), (std::array<uint32_t, 2>{1u << 30, 3u << 30}));
    EXPECT_EQ(sobol(3), (std::array<uint32_t, 2>{3u << 30, 1u << 30}));
    EXPECT_EQ(sobol(5), (std::array<uint32_t, 2>{5u << 29, 1u << 29}));
}

TEST(Sobol, PointsAreThoseOfTheDefinitionOnAnyNumberOfLanes) {
    const std::vector<uint32_t> seeds = random_seeds(7);
    for (const int lanes : {1, 4, 8, 16}) {
        const std::vector<SquarePoint> points = points_of(999, seeds, lanes);
        for (size_t i = 0; i < points.size(); ++i)
            ASSERT_EQ(points[i], defined_point(uint32_t(i % 999), seeds[i / 999]))
                << lanes << " lanes, point " << i;
    }
}

TEST(Sobol, AsManyPartsAsThereMayBeEmittersAreAlmostEqual) {
    // The first and the last fraction of each part: 4096 or 4097 lie between them.
    constexpr uint64_t kParts = (1u << 20) - 3;
    std::vector<uint32_t> fractions;
    for (uint64_t part = 0; part < kParts; part += 77) {
        const auto first = [](uint64_t i) { return ((i << 32) + kParts - 1) / kParts; };
        fractions.push_back(uint32_t(first(part)));
        fractions.push_back(uint32_t(first(part + 1) - 1));
    }
    const auto count = uint32_t(fractions.size());
    fractions.resize((count + 15) / 16 * 16);
    const Device device = test_device();
    Buffer<uint32_t> numbers(device, "numbers", fractions.size());
    Program::from_text(device, kSource, {})
        .kernel("number_parts")
        .launch_packets(count, count,
                        Buffer<uint32_t>(device, "fractions", std::span<const uint32_t>(fractions)),
                        uint32_t(kParts), numbers);
    const std::vector<uint32_t> found = numbers.read();
    for (uint32_t i = 0; i < count; ++i) ASSERT_EQ(found[i], i / 2 * 77) << fractions[i];
}

TEST(Sobol, SuccessiveSamplesFillEveryDivisionIntoEqualBoxes) {
    constexpr uint32_t kCount = 1024;
    const std::vector<uint32_t> seeds = random_seeds(20);
    const std::vector<SquarePoint> points = points_of(kCount, seeds);
    for (size_t seed = 0; seed < seeds.size(); ++seed)
        for (int k = 0; k <= 10; ++k)
            for (uint32_t begin = 0; begin < kCount; begin += 1u << k)
                for (int along_x = 0; along_x <= k; ++along_x) {
                    std::set<std::pair<int, int>> boxes;
                    for (uint32_t i = begin; i < begin + (1u << k); ++i) {
                        const SquarePoint& p = points[seed * kCount + i];
                        boxes.emplace(int(std::ldexp(p.x, along_x)),
                                      int(std::ldexp(p.y, k - along_x)));
                    }
                    ASSERT_EQ(boxes.size(), size_t{1} << k)
                        << "seed " << seed << ", samples from " << begin << " on, 2^" << along_x
                        << " boxes along x of 2^" << k;
                }
}

TEST(Sobol, PointsOfDifferentSeedsAreNotCorrelated) {
    constexpr uint32_t kSeeds = 20000;
    const std::vector<SquarePoint> points = points_of(1, random_seeds(kSeeds));
    double mean_x = 0, mean_y = 0, product = 0, successive = 0;
    for (size_t i = 0; i + 1 < kSeeds; ++i) {
        mean_x += points[i].x / kSeeds;
        mean_y += points[i].y / kSeeds;
        product += (points[i].x - 0.5) * (points[i].y - 0.5) * 12 / kSeeds;
        successive += (points[i].x - 0.5) * (points[i + 1].x - 0.5) * 12 / kSeeds;
    }
    const double error = 1 / std::sqrt(double(kSeeds));
    EXPECT_NEAR(mean_x, 0.5, 3.5 * error / std::sqrt(12.0));
    EXPECT_NEAR(mean_y, 0.5, 3.5 * error / std::sqrt(12.0));
    EXPECT_NEAR(product, 0, 3.5 * error);
    EXPECT_NEAR(successive, 0, 3.5 * error);
}

/// The mean square error of the integral of a smooth function from `count` points a seed.
double square_error(uint32_t count, const std::vector<uint32_t>& seeds) {
    const std::vector<SquarePoint> points = points_of(count, seeds);
    const double exact = (std::exp(1.0) - 1) * std::sin(1.0);
    double sum = 0;
    for (size_t seed = 0; seed < seeds.size(); ++seed) {
        double mean = 0;
        for (uint32_t i = 0; i < count; ++i) {
            const SquarePoint& p = points[seed * count + i];
            mean += std::exp(p.x) * std::cos(p.y) / count;
        }
        sum += (mean - exact) * (mean - exact) / double(seeds.size());
    }
    return sum;
}

TEST(Sobol, ErrorOfASmoothIntegralFallsFasterThanThatOfRandomPoints) {
    const std::vector<uint32_t> seeds = random_seeds(64);
    // Variance of one random point: 0.27. Owen 1997: of scrambled nets it falls almost as N^-3.
    const double of_16 = square_error(16, seeds), of_256 = square_error(256, seeds);
    EXPECT_LT(of_16, 0.27 / 16 / 8);
    EXPECT_LT(of_256, of_16 / 1000);
}

}  // namespace
}  // namespace voxelume
