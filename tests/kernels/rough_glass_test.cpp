// SPDX-License-Identifier: Apache-2.0
// lib/light/rough_glass.h against Walter's formulas in double precision, and against what must hold
// of any surface that loses no light, seen from outside and from inside.
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "tests/kernels/rough_glass_fixture.hpp"
#include "tests/oracles/glass_surface.hpp"
#include "tests/oracles/physical_surface.hpp"

namespace voxelume {
namespace {

using oracle::at_cosine;

std::vector<GlassSurface> glass_surfaces() {
    std::vector<GlassSurface> list;
    size_t turn = 0;
    for (const auto& [roughness, ior] :
         {std::pair(0.3, 1.5), std::pair(0.6, 1.5), std::pair(1.0, 1.33), std::pair(0.5, 2.4)})
        for (const uint32_t inside : in_turn<uint32_t>({0, 1}, turn++))
            list.push_back({roughness, ior, 1, 0, inside});
    return list;
}
INSTANTIATE_TEST_SUITE_P(Physical, RoughGlass, testing::ValuesIn(glass_surfaces()));

/// A direction on either side.
template <class Random>
glm::dvec3 any_direction(Random& random) {
    std::uniform_real_distribution<double> any(0, 1);
    const double z = 2 * any(random) - 1;
    return at_cosine(std::copysign(0.01 + 0.99 * std::abs(z), z),
                     2 * std::numbers::pi * any(random));
}

TEST_P(RoughGlass, ReturnsAndLetsThroughWhatTheFormulasSay) {
    const GlassSurface s = GetParam();
    const double alpha = width_of(s.roughness);
    oracle::GlassFormulas outside(alpha, 1, s.ior), inside(alpha, s.ior, 1);
    oracle::GlassFormulas& here = s.inside ? inside : outside;
    oracle::GlassFormulas& behind = s.inside ? outside : inside;
    const double back = glass_table(alpha, s.ior).back[s.inside];
    std::mt19937 random(7);
    std::vector<double> outs;
    std::vector<glm::dvec3> ins;
    for (const double cosine : {0.05, 0.3, 0.6, 0.95})
        for (int k = 0; k < 6; ++k) outs.push_back(cosine), ins.push_back(any_direction(random));
    const std::vector<Value> found = values(s, outs, ins);
    for (size_t k = 0; k < outs.size(); ++k) {
        const double in = ins[k].z;
        oracle::GlassFormulas& side = in > 0 ? here : behind;
        const double later = here.missing(outs[k]) * side.missing(std::abs(in)) *
                             (in > 0 ? back : 1 - back) / side.mean_missing() * std::abs(in);
        const double expected = here.at_once(at_cosine(outs[k]), ins[k]) + later;
        ASSERT_NEAR(found[k].white, expected, 4e-3 * expected + 1.5e-3)
            << "out " << outs[k] << ", in " << in;
        const double tint = in > 0 ? 1 : 0.5;
        ASSERT_NEAR(found[k].half, tint * found[k].white, 1e-5) << "out " << outs[k];
    }
}

TEST_P(RoughGlass, ReturnsAsMuchInBothDirections) {
    GlassSurface s = GetParam(), other = s;
    std::mt19937 random(8);
    std::uniform_real_distribution<double> any(0, 1);
    for (const bool through : {false, true}) {
        std::vector<double> outs, swapped_outs;
        std::vector<glm::dvec3> ins, swapped_ins;
        const double side = through ? -1 : 1;
        for (int k = 0; k < 200; ++k) {
            const double out = 0.01 + 0.99 * any(random), in = 0.01 + 0.99 * any(random);
            const double turn = std::numbers::pi * any(random);
            outs.push_back(out), ins.push_back(at_cosine(side * in, turn));
            swapped_outs.push_back(in), swapped_ins.push_back(at_cosine(side * out, turn));
        }
        other.inside = through ? 1 - s.inside : s.inside;
        const auto there = values(s, outs, ins), back = values(other, swapped_outs, swapped_ins);
        const double here = s.inside ? s.ior : 1, behind = s.inside ? 1 : s.ior;
        const double squares = through ? here * here / (behind * behind) : 1;
        for (size_t k = 0; k < outs.size(); ++k) {
            const double forth = there[k].white / std::abs(ins[k].z) * squares;
            // Directions in floats turn facets by about 1e-7 over what they bend light.
            ASSERT_NEAR(back[k].white / std::abs(swapped_ins[k].z), forth, 1e-3 * forth + 1e-5)
                << outs[k] << " and " << ins[k].z;
        }
    }
}

std::vector<GlassSurface> clear_surfaces() {
    std::vector<GlassSurface> list;
    size_t turn = 0;
    for (const double roughness : {0.02, 0.1, 0.3, 0.6, 1.0})
        for (const uint32_t inside : in_turn<uint32_t>({0, 1}, turn++))
            list.push_back({roughness, 1.5, 1, 0, inside});
    list.push_back({0.4, 1.5, 0.5, 0.5, 0});
    list.push_back({0.4, 1.5, 0.5, 0.5, 1});
    list.push_back({0.6, 0.75, 1, 0, 0});
    list.push_back({0.5, 2.4, 1, 0, 1});
    return list;
}

class ClearGlass : public RoughGlass {};
INSTANTIATE_TEST_SUITE_P(Physical, ClearGlass, testing::ValuesIn(clear_surfaces()));

TEST_P(ClearGlass, LosesNoLightAtAnyAngle) {
    // Points of one seed are not independent of each other, so seeds tell the error.
    constexpr uint32_t kCount = 1u << 15, kSeeds = 8;
    for (const double cosine : {0.1, 0.4, 0.6, 0.75, 0.83, 1.0}) {
        double sum = 0, squares = 0;
        for (uint32_t seed = 0; seed < kSeeds; ++seed) {
            const std::vector<float> ways = scattered(GetParam(), cosine, kCount, seed);
            double mean = 0;
            for (size_t k = 0; k < kCount; ++k)
                mean += double(ways[3 * kCount + k]) / std::numbers::pi / kCount;
            sum += mean / kSeeds, squares += mean * mean / kSeeds;
        }
        const double error = std::sqrt(std::max(squares - sum * sum, 0.0) / (kSeeds - 1));
        EXPECT_LT(error, cosine < 0.4 ? 2e-3 : 1e-3) << "cosine " << cosine;
        EXPECT_NEAR(sum, 1, 5e-4 + 3 * error) << "cosine " << cosine << ", error " << error;
    }
}

TEST_P(RoughGlass, ScattersPathsAsTheDensitySays) {
    constexpr int kRows = 10, kColumns = 8, kFine = 48;
    constexpr uint32_t kCount = 1u << 16;
    for (const double cosine : {0.2, 0.9}) {
        std::vector<double> outs(size_t{kRows} * kColumns * kFine * kFine, cosine);
        std::vector<glm::dvec3> ins;
        for (int cell = 0; cell < kRows * kColumns; ++cell)
            for (int k = 0; k < kFine * kFine; ++k)
                ins.push_back(
                    at_cosine(2 * (cell / kColumns + (k / kFine + 0.5) / kFine) / kRows - 1,
                              2 * std::numbers::pi * (cell % kColumns + (k % kFine + 0.5) / kFine) /
                                  kColumns));
        const std::vector<Value> densities = values(GetParam(), outs, ins);
        std::vector<double> expected(size_t{kRows} * kColumns), found(expected.size());
        double all = 0;
        for (size_t k = 0; k < ins.size(); ++k) {
            const double share =
                densities[k].density * 4 * std::numbers::pi / double(ins.size()) * kCount;
            expected[k / (kFine * kFine)] += share;
            all += share / kCount;
        }
        // The rest is mirrored into the surface, or bent out of it.
        EXPECT_LE(all, 1.002);
        const std::vector<float> ways = scattered(GetParam(), cosine, kCount, 17);
        for (size_t k = 0; k < kCount; ++k) {
            if (ways[3 * kCount + k] <= 0) continue;
            const double x = ways[k], y = ways[kCount + k], z = ways[2 * kCount + k];
            const double turn = std::atan2(y, x) / (2 * std::numbers::pi);
            const int row = std::clamp(int((z + 1) / 2 * kRows), 0, kRows - 1);
            const int column = std::min(int((turn - std::floor(turn)) * kColumns), kColumns - 1);
            ++found[size_t(row * kColumns + column)];
        }
        double sum = 0, cells = 0;
        for (size_t cell = 0; cell < found.size(); ++cell) {
            if (expected[cell] < 8) continue;
            sum += std::pow(found[cell] - expected[cell], 2) / expected[cell];
            ++cells;
        }
        EXPECT_LT(sum, cells + 4 * std::sqrt(2 * cells)) << cells << " cells, cosine " << cosine;
    }
}

class RoughGlassLanes : public RoughGlass {};
INSTANTIATE_TEST_SUITE_P(Physical, RoughGlassLanes,
                         testing::Values(GlassSurface{0.4, 1.5, 0.7, 0.2, 1}));

TEST_P(RoughGlassLanes, AreTheSameInAnyNumber) {
    const GlassSurface s = GetParam();
    const std::vector<float> one = scattered(s, 0.6, 1024, 3, 1);
    for (const int lanes : in_turn<int>({4, 8, 16}, 1))
        EXPECT_EQ(scattered(s, 0.6, 1024, 3, lanes), one);
}

}  // namespace
}  // namespace voxelume
