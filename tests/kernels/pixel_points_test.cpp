// SPDX-License-Identifier: Apache-2.0
// lib/sampling/pixel_points.h against its definition, in polynomials on the host, and what it
// promises of the pixels of a square.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <numbers>
#include <random>
#include <set>
#include <span>
#include <tuple>

#include "runtime/opencl/program.hpp"
#include "tests/kernels/owen_points.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kPixelSource = R"(
#include "lib/sampling/pixel_points.h"
#include "lib/lanes/work_item.h"
kernel void sample_pixels(uint count, global const uint* samples, global const uint* pixels,
                          global const uint* decisions, uint stride, global float* points) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const SampledPixels s = sampled_pixels(LANES_LOAD(pixels, first), LANES_LOAD(samples, first));
    const SquarePoint p = pixel_point(&s, LANES_LOAD(decisions, first));
    LANES_STORE(p.x, points, first);
    LANES_STORE(p.y, points, stride + first);
}
)";

/// A sample of a pixel for a decision.
struct Asked {
    uint32_t sample, column, row, decision;
    uint32_t pixel() const { return column + 65536 * row; }
};

std::vector<SquarePoint> pixel_points_of(const std::vector<Asked>& asked, int lanes = 0) {
    const Device device = test_device(lanes);
    const auto count = uint32_t(asked.size()), stride = (count + 15) / 16 * 16;
    std::vector<uint32_t> samples(stride), pixels(stride), decisions(stride);
    for (size_t i = 0; i < count; ++i) {
        samples[i] = asked[i].sample;
        pixels[i] = asked[i].pixel();
        decisions[i] = asked[i].decision;
    }
    const auto buffer = [&](const char* name, const std::vector<uint32_t>& values) {
        return Buffer<uint32_t>(device, name, std::span<const uint32_t>(values));
    };
    Buffer<float> points(device, "points", size_t(stride) * 2);
    Program::from_text(device, kPixelSource, {})
        .kernel("sample_pixels")
        .launch_packets(count, count, buffer("samples", samples), buffer("pixels", pixels),
                        buffer("decisions", decisions), stride, points);
    const std::vector<float> values = points.read();
    std::vector<SquarePoint> result;
    for (size_t i = 0; i < count; ++i) result.push_back({values[i], values[stride + i]});
    return result;
}

/// A polynomial over two elements; bit i is the coefficient of z^i.
using Polynomial = uint64_t;

Polynomial times(Polynomial a, Polynomial b) {
    Polynomial sum = 0;
    for (int i = 0; i < 64; ++i)
        if (a >> i & 1) sum ^= b << i;
    return sum;
}

/// The polynomial of z + 1 in place of z.
Polynomial at_one_more(Polynomial p) {
    Polynomial result = 0;
    for (int i = 63; i >= 0; --i) result = times(result, 3) ^ (p >> i & 1);
    return result;
}

/// The first 32 coefficients of a / b as a power series, the first the highest bit.
uint32_t series(Polynomial a, Polynomial b) {
    uint32_t digits = 0;
    for (int i = 0; i < 32; ++i) {
        const bool digit = a & 1;
        if (digit) a ^= b;
        a >>= 1;
        digits = 2 * digits + digit;
    }
    return digits;
}

uint32_t random_of(uint32_t number, uint32_t seed) {
    return uint32_t(mixed(number + 0x9E3779B9u) * uint64_t(seed | 1) % 0x100000000 / 65536);
}

/// The quarters of a square that its own become, for each of three turns.
constexpr int kTurned[3][4] = {{0, 1, 2, 3}, {0, 2, 3, 1}, {0, 3, 1, 2}};

/// The sum of (u_j + v_j z) / (1 + z + z^2)^j for a pixel's rearranged places, as a numerator over
/// the second power.
Polynomial numerator_of(const Asked& asked, uint32_t seed) {
    Polynomial sum = 0;
    for (uint32_t j = 0; j < 2; ++j) {
        const uint32_t side = 2u << j;
        const Asked corner = {0, asked.column / side * side, asked.row / side * side, 0};
        const uint32_t random =
            j == 1 ? seed / 65536 : random_of(corner.pixel() ^ 0x80000000, seed);
        const uint32_t u = asked.column % side * 2 / side, v = asked.row % side * 2 / side;
        const int turned = kTurned[random / 256 * 3 / 256][2 * v + u];
        sum ^= times(Polynomial(turned) ^ random % 4, j == 0 ? 0b111 : 1);
    }
    return sum;
}

uint32_t exchanged(uint32_t sample, uint32_t random) {
    uint32_t first = 1;
    while (first <= sample / 2) first *= 2;
    return sample == 0 ? 0 : first + ((sample - first) ^ random % first);
}

SquarePoint defined_pixel_point(const Asked& asked) {
    const Asked square = {0, asked.column / 4 * 4, asked.row / 4 * 4, 0};
    const uint32_t seed = mixed(mixed(square.pixel() + 0x9E3779B9u) + asked.decision);
    const Polynomial numerator = numerator_of(asked, seed), below = times(7, 7);
    const uint32_t sample = exchanged(asked.sample, random_of(asked.pixel(), ~seed));
    const auto [x, y] = sobol(value_of(scrambled(bits_of(sample), seed)));
    return owen_point(x ^ series(numerator, below), y ^ series(at_one_more(numerator), below),
                      seed);
}

/// The first `samples` samples of all pixels of a square of `side` pixels, sample after sample.
std::vector<Asked> square_of(uint32_t column, uint32_t row, uint32_t side, uint32_t samples,
                             uint32_t decision) {
    std::vector<Asked> asked;
    for (uint32_t sample = 0; sample < samples; ++sample)
        for (uint32_t y = 0; y < side; ++y)
            for (uint32_t x = 0; x < side; ++x)
                asked.push_back({sample, column + x, row + y, decision});
    return asked;
}

/// True if 2^k points fall one each into the 2^k boxes of all shapes.
void expect_one_in_each_box(std::span<const SquarePoint> points, int k, const std::string& of) {
    for (int along_x = 0; along_x <= k; ++along_x) {
        std::set<std::pair<int, int>> boxes;
        for (const auto& [x, y] : points)
            boxes.emplace(int(std::ldexp(x, along_x)), int(std::ldexp(y, k - along_x)));
        ASSERT_EQ(boxes.size(), size_t{1} << k) << of << ", 2^" << along_x << " boxes along x";
    }
}

TEST(PixelPoints, AreThoseOfTheDefinitionOnAnyNumberOfLanes) {
    std::mt19937 random(20261128);
    std::vector<Asked> asked = {{0, 65535, 65535, 0xFFFFFFFF}, {0xFFFFFFFF, 0, 0, 0}};
    while (asked.size() < 3001)
        asked.push_back({uint32_t(random()) >> random() % 32, uint32_t(random() % 65536),
                         uint32_t(random() % 65536), uint32_t(random())});
    for (const int lanes : {1, 4, 8, 16}) {
        const std::vector<SquarePoint> points = pixel_points_of(asked, lanes);
        for (size_t i = 0; i < points.size(); ++i)
            ASSERT_EQ(points[i], defined_pixel_point(asked[i]))
                << lanes << " lanes, pixel " << asked[i].column << ", " << asked[i].row
                << ", sample " << asked[i].sample << ", decision " << asked[i].decision;
    }
}

TEST(PixelPoints, FirstSamplesOfASquareFillEveryDivisionIntoEqualBoxes) {
    for (const auto& [column, row, decision] :
         std::vector<std::tuple<uint32_t, uint32_t, uint32_t>>{
             {0, 0, 0}, {8, 8, 1}, {1916, 1076, 0x2FFFE}, {44, 65532, 7}})
        for (int level = 0; level <= 2; ++level) {
            const uint32_t side = 1u << level;
            const std::vector<SquarePoint> points =
                pixel_points_of(square_of(column, row, side, 64, decision));
            for (int k = 0; k <= 6; ++k)
                expect_one_in_each_box(std::span(points).first(size_t(side * side) << k),
                                       k + 2 * level,
                                       fmt::format("{} samples of {} pixels", 1 << k, side * side));
        }
}

TEST(PixelPoints, SuccessiveSamplesOfOnePixelFillEveryDivisionIntoEqualBoxes) {
    constexpr uint32_t kCount = 256;
    for (const uint32_t decision : {0u, 0x1FFFFu})
        for (const uint32_t column : {5u, 1917u}) {
            std::vector<Asked> asked;
            for (uint32_t i = 0; i < kCount; ++i) asked.push_back({i, column, 66, decision});
            const std::vector<SquarePoint> points = pixel_points_of(asked);
            for (int k = 0; k <= 8; ++k)
                for (uint32_t begin = 0; begin < kCount; begin += 1u << k)
                    expect_one_in_each_box(std::span(points).subspan(begin, size_t{1} << k), k,
                                           fmt::format("2^{} samples from {} on", k, begin));
        }
}

/// The mean squares of what pixels and squares of 2 x 2 and 4 x 4 have too much of `light`, whose
/// mean is 0, with some samples of two decisions.
template <class Light>
std::array<double, 3> square_errors(uint32_t samples, const Light& light) {
    constexpr uint32_t kSide = 128;
    std::vector<Asked> first = square_of(64, 128, kSide, samples, 0), second = first;
    for (Asked& asked : second) asked.decision = 1;
    const std::vector<SquarePoint> a = pixel_points_of(first), b = pixel_points_of(second);
    std::array<double, 3> errors{};
    for (uint32_t level = 0; level < 3; ++level) {
        const uint32_t side = 1u << level, across = kSide >> level;
        std::vector<double> means(size_t(across) * across);
        for (size_t i = 0; i < a.size(); ++i) {
            const uint32_t x = first[i].column - 64, y = first[i].row - 128;
            means[size_t(y / side) * across + x / side] +=
                light(a[i], b[i]) / (double(side) * side * samples);
        }
        for (const double mean : means) errors[level] += mean * mean / double(means.size());
    }
    return errors;
}

TEST(PixelPoints, ErrorsOfNeighboursCancel) {
    // Independent errors of the pixels of a square would have 1/4 and 1/16 of the square error of
    // one. Of a disk's edge less is left, the less the larger the square is.
    const auto disk = [](const SquarePoint& p, const SquarePoint&) {
        return double(std::hypot(p.x, p.y) < 0.75) - std::numbers::pi * 0.75 * 0.75 / 4;
    };
    for (const uint32_t samples : {1u, 4u, 16u}) {
        const std::array<double, 3> errors = square_errors(samples, disk);
        EXPECT_LT(errors[1], errors[0] / 4 * 0.65) << samples;
        EXPECT_LT(errors[2], errors[0] / 16 * 0.4) << samples;
    }
}

TEST(PixelPoints, ErrorsOfTwoDecisionsHardlyAddUp) {
    // Errors that depend on how two decisions are paired can't cancel. Quarters that are rearranged
    // independently agree in a ninth of the possible cases: 3 neighbours add a third. From 4
    // samples on, they are exchanged.
    const auto paired = [](const SquarePoint& p, const SquarePoint& q) {
        return (p.x < 0.5) == (q.x < 0.5) ? 1.0 : -1.0;
    };
    for (const auto& [samples, maximum] :
         {std::pair{1u, 1.5}, std::pair{4u, 1.3}, std::pair{64u, 1.1}}) {
        const std::array<double, 3> errors = square_errors(samples, paired);
        for (size_t level = 1; level < 3; ++level)
            EXPECT_LT(errors[level], std::ldexp(errors[0], -2 * int(level)) * maximum)
                << samples << " samples, squares of 2^" << level;
    }
}

TEST(PixelPoints, SquaresAndDecisionsAreNotCorrelated) {
    // The first pixels of 4096 squares: successive squares, and two decisions.
    std::vector<Asked> asked;
    for (uint32_t i = 0; i < 4096; ++i)
        for (const uint32_t decision : {3u, 4u})
            asked.push_back({0, i % 64 * 4, i / 64 * 4, decision});
    const std::vector<SquarePoint> points = pixel_points_of(asked);
    double mean = 0, squares = 0, decisions = 0;
    for (size_t i = 0; i + 2 < points.size(); i += 2) {
        mean += (points[i].x - 0.5) / 4095;
        squares += (points[i].x - 0.5) * (points[i + 2].x - 0.5) * 12 / 4095;
        decisions += (points[i].x - 0.5) * (points[i + 1].x - 0.5) * 12 / 4095;
    }
    const double error = 1 / std::sqrt(4095.0);
    EXPECT_NEAR(mean, 0, 3.5 * error / std::sqrt(12.0));
    EXPECT_NEAR(squares, 0, 3.5 * error);
    EXPECT_NEAR(decisions, 0, 3.5 * error);
}

}  // namespace
}  // namespace voxelume
