// SPDX-License-Identifier: Apache-2.0
// lib/surface/texture_mean.h: values at points against exact bilinear ones in double, and means
// over parallelograms against those of many such values.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "kernels/shared/texture.h"
#include "runtime/image/srgb.hpp"
#include "runtime/io/mesh/texture_levels.hpp"
#include "runtime/opencl/program.hpp"
#include "tests/oracles/texture_oracle.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kAreas = 512;

constexpr const char* kMeanSource = R"(
#include "lib/lanes/work_item.h"
#include "lib/lanes/vector.h"
#include "lib/surface/texture_mean.h"
kernel void mean_of_areas(uint count, global const float* areas, global const uint* places,
                          global const uint* textures, global float* means) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    TextureArea a;
    a.u = LANES_LOAD(areas, first);
    a.v = LANES_LOAD(areas, count + first);
    for (uint i = 0; i < 2; ++i) {
        a.side_u[i] = LANES_LOAD(areas, (2 + 2 * i) * count + first);
        a.side_v[i] = LANES_LOAD(areas, (3 + 2 * i) * count + first);
        a.off[i] = a.lean[i] = (lane_float)0.0f;
    }
    const lane_uint place = LANES_LOAD(places, first);
    lane_float mean[4];
    texture_mean(textures, place, &a, LANE_MASK(place != VXL_NO_TEXTURE), mean);
    const Vector color = {mean[0], mean[1], mean[2]};
    store_vector(color, means, count, first);
}
)";

/// A parallelogram on one of the pictures, and what is asked of it.
struct Area {
    glm::dvec2 middle{0}, across{0}, down{0};
    size_t picture = 0;
};

oracle::Picture noise(int width, int height, oracle::Beyond u, oracle::Beyond v, uint32_t seed) {
    std::mt19937 random(seed);
    std::uniform_int_distribution<int> code(0, 255);
    oracle::Picture picture{width, height, {}, u, v};
    for (int i = 0; i < width * height; ++i)
        picture.texels.push_back(
            {uint8_t(code(random)), uint8_t(code(random)), uint8_t(code(random))});
    return picture;
}

std::vector<oracle::Picture> pictures() {
    using enum oracle::Beyond;
    return {noise(1, 1, repeat, clamp, 1), noise(7, 5, repeat, mirror, 2),
            noise(64, 64, clamp, repeat, 3), noise(33, 128, mirror, clamp, 4)};
}

/// All pictures in the form that kernels read.
class Textures {
  public:
    explicit Textures(const std::vector<oracle::Picture>& pictures) {
        for (const float level : srgb_levels()) words_.push_back(std::bit_cast<uint32_t>(level));
        for (const oracle::Picture& from : pictures) {
            Picture picture{from.width, from.height, {}};
            for (const auto& [r, g, b] : from.texels) picture.pixels.push_back({r, g, b, 255});
            places_.push_back(uint32_t(words_.size()));
            words_.insert(words_.end(),
                          {uint32_t(from.width), uint32_t(from.height),
                           uint32_t(from.beyond_u) | uint32_t(from.beyond_v) << 4, 0u});
            const TextureImage levels = with_levels(picture);
            words_.insert(words_.end(), levels.texels.begin(), levels.texels.end());
        }
    }

    std::vector<glm::dvec3> means(const Device& device, const std::vector<Area>& areas) const {
        std::vector<float> values(6 * kAreas);
        std::vector<uint32_t> places(kAreas, VXL_NO_TEXTURE);
        for (size_t i = 0; i < areas.size(); ++i) {
            const glm::dvec2 parts[] = {areas[i].middle, areas[i].across, areas[i].down};
            for (size_t k = 0; k < 6; ++k) values[k * kAreas + i] = float(parts[k / 2][int(k % 2)]);
            places[i] = places_[areas[i].picture];
        }
        const Buffer<float> means(device, "means", 3 * kAreas);
        Program::from_text(device, kMeanSource, {{"VXL_TEXTURE_ALPHA", 0}})
            .kernel("mean_of_areas")
            .launch_packets(
                kAreas, kAreas, Buffer<float>(device, "areas", std::span<const float>(values)),
                Buffer<uint32_t>(device, "places", std::span<const uint32_t>(places)),
                Buffer<uint32_t>(device, "textures", std::span<const uint32_t>(words_)), means);
        const std::vector<float> flat = means.read();
        std::vector<glm::dvec3> colors;
        for (size_t i = 0; i < areas.size(); ++i)
            colors.emplace_back(flat[i], flat[kAreas + i], flat[2 * kAreas + i]);
        return colors;
    }

  private:
    std::vector<uint32_t> words_, places_;
};

/// The mean of `each` bilinear values in each direction.
glm::dvec3 mean_of(const oracle::Picture& picture, const Area& area, int each) {
    glm::dvec3 sum(0);
    for (int j = 0; j < each; ++j)
        for (int i = 0; i < each; ++i) {
            const double a = (i + 0.5) / each - 0.5, b = (j + 0.5) / each - 0.5;
            sum += oracle::bilinear(picture, area.middle + a * area.across + b * area.down);
        }
    return sum / double(each * each);
}

TEST(TextureMean, AtPointsIsTheExactBilinearValue) {
    const std::vector<oracle::Picture> all = pictures();
    std::mt19937 random(7);
    std::uniform_real_distribution<float> place(-2.5f, 2.5f);
    std::vector<Area> areas;
    for (size_t i = 0; i < kAreas; ++i)
        areas.push_back({{place(random), place(random)}, {}, {}, i % all.size()});
    areas[0].middle = {0, 1}, areas[1].middle = {-1, 2}, areas[2].middle = {1, 0};
    const std::vector<glm::dvec3> means = Textures(all).means(test_device(), areas);
    for (size_t i = 0; i < areas.size(); ++i) {
        const glm::dvec3 exact = oracle::bilinear(all[areas[i].picture], areas[i].middle);
        // A place of 2.5 widths has an error of 2^-23, of a texel 128 times as much.
        ASSERT_LT(glm::distance(means[i], exact), 5e-5) << i;
    }
}

TEST(TextureMean, OverParallelogramsIsThatOfManyValues) {
    const std::vector<oracle::Picture> all = pictures();
    std::mt19937 random(8);
    std::uniform_real_distribution<double> part(0, 1);
    std::vector<Area> areas;
    for (size_t i = 0; i < kAreas; ++i) {
        const double turn = 2 * std::numbers::pi * part(random);
        const double lean = turn + std::numbers::pi * (0.25 + 0.5 * part(random));
        const double length = std::exp2(-7 + 6 * part(random));
        const glm::dvec2 across = length * glm::dvec2(std::cos(turn), std::sin(turn));
        const glm::dvec2 down =
            length * std::exp2(-2 * part(random)) * glm::dvec2(std::cos(lean), std::sin(lean));
        areas.push_back({{part(random), part(random)}, across, down, i % all.size()});
    }
    const std::vector<glm::dvec3> means = Textures(all).means(test_device(), areas);
    double squares = 0;
    for (size_t i = 0; i < areas.size(); ++i) {
        const glm::dvec3 off = means[i] - mean_of(all[areas[i].picture], areas[i], 32);
        squares += glm::dot(off, off) / 3;
        // White noise is the hardest picture: neighbours have nothing in common.
        ASSERT_LT(glm::length(off), 0.15) << i;
    }
    EXPECT_LT(255 * std::sqrt(squares / double(areas.size())), 2.5);
}

TEST(TextureMean, OfWhatIsNoNumberOrBeyondAllBoundsIsSomeColor) {
    const std::vector<oracle::Picture> all = pictures();
    std::vector<Area> areas;
    for (const double odd : {double(NAN), double(INFINITY), -3e38, 3e38, 1e20})
        for (size_t picture = 0; picture < all.size(); ++picture) {
            areas.push_back({{odd, 0.5}, {}, {}, picture});
            areas.push_back({{0.5, odd}, {0.1, 0}, {0, 0.1}, picture});
            areas.push_back({{0.5, 0.5}, {odd, 0}, {0, odd}, picture});
            areas.push_back({{0.5, 0.5}, {0.1, odd}, {0, 1e-30}, picture});
        }
    for (const glm::dvec3& color : Textures(all).means(test_device(), areas))
        for (int c = 0; c < 3; ++c) ASSERT_TRUE(color[c] >= 0 && color[c] <= 1.0001) << color[c];
}

}  // namespace
}  // namespace voxelume
