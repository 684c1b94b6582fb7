// SPDX-License-Identifier: Apache-2.0
// lib/light/rough_glass.h against Walter's formulas in double precision, and against what must hold
// of any surface that loses no light, seen from outside and from inside.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "runtime/stages/features.hpp"
#include "runtime/stages/light/albedo_table.hpp"
#include "runtime/stages/light/glass_table.hpp"
#include "tests/oracles/glass_surface.hpp"
#include "tests/oracles/physical_surface.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kGlassSource = R"(
#include "lib/lanes/work_item.h"
#include "lib/light/physical.h"
#include "lib/light/sobol.h"
static PhysicalView glass_at(global const float* materials, lane_float cosine, uint inside) {
    const Vector n = {(lane_float)0.36f, (lane_float)0.48f, (lane_float)-0.8f};
    const Frame f = frame_around(n);
    const Vector out = {exact_sqrt(1.0f - cosine * cosine), (lane_float)0.0f, cosine};
    return view_physical(materials, (lane_int)-1, (lane_uint)0, (lane_uint)0, 0, (lane_uint)0, n,
                         out_of_frame(&f, out), (lane_int)(inside ? -1 : 0));
}
static lane_int glass_light(const PhysicalView* s, Vector way, lane_float* value,
                            lane_float* density) {
    lane_float beyond[3], likely;
    const lane_int above = physical_value(s, way, value, density);
    const lane_int through = physical_through(s, way, beyond, &likely);
    for (int c = 0; c < 3; ++c) value[c] = LANES_SELECT(through, beyond[c], value[c]);
    *density = LANES_SELECT(through, likely, *density);
    return above | through;
}
kernel void value_glass(global const float* materials, uint inside, uint count,
                        global const float* outs, global const float* ins, uint stride,
                        global float* values) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const PhysicalView s = glass_at(materials, LANES_LOAD(outs, first), inside);
    lane_float value[3], density;
    glass_light(&s, out_of_frame(&s.frame, load_vector(ins, stride, first)), value, &density);
    LANES_STORE(value[0], values, first);
    LANES_STORE(value[1], values, stride + first);
    LANES_STORE(density, values, 2u * stride + first);
}
kernel void scatter_glass(global const float* materials, uint inside, uint count, float out,
                          uint seed, uint stride, global float* ways) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_uint number = LANES_AS_UINT(LANES_NUMBERS + (int)first);
    const PhysicalView s = glass_at(materials, (lane_float)out, inside);
    const SquarePoint at = sobol_point(number, decision_seed((lane_uint)seed, (lane_uint)0));
    const lane_float layer = sobol_point(number, decision_seed((lane_uint)seed, (lane_uint)1)).x;
    lane_int down;
    const Vector way = physical_direction(&s, at, layer, &down);
    const Vector in_frame = into_frame(&s.frame, way);
    store_vector(in_frame, ways, stride, first);
    lane_float value[3], density;
    const lane_int meant = ~(down ^ LANE_MASK(in_frame.z < 0.0f));
    const lane_int some =
        meant & glass_light(&s, way, value, &density) & LANE_MASK(density > 0.0f);
    const lane_float weight =
        exact_divide(value[0], LANES_SELECT(some, density, (lane_float)1.0f));
    LANES_STORE(LANES_SELECT(some, weight, (lane_float)0.0f), ways, 3u * stride + first);
}
)";

using oracle::at_cosine;

struct GlassSurface {
    double roughness = 0.5, ior = 1.5, share = 1, metallic = 0;
    uint32_t inside = 0;
};

void PrintTo(const GlassSurface& s, std::ostream* out) {
    *out << "roughness " << s.roughness << ", ior " << s.ior << ", glass " << s.share
         << (s.inside ? ", from inside" : "");
}

/// A material's record and its tables. Its colour is white, but for half green.
std::vector<float> floats_of(const GlassSurface& s) {
    const double width = width_of(s.roughness);
    const AlbedoTable table = albedo_table(width);
    const GlassTable glass = glass_table(width, s.ior);
    MaterialRecord record{};
    record.color[0] = record.color[2] = 1, record.color[1] = 0.5f;
    record.metallic = float(s.metallic);
    record.width = float(width);
    record.reflectance = float(std::pow((s.ior - 1) / (s.ior + 1), 2));
    record.albedos = VXL_MATERIAL_FLOATS;
    record.missing = float(table.missing);
    record.matt = float((1 - s.metallic) / passed_share(record.reflectance, table));
    record.refraction = float(s.share);
    record.shininess = float(VXL_MATERIAL_FLOATS + table.values.size());
    std::vector<float> floats(VXL_MATERIAL_FLOATS);
    std::memcpy(floats.data(), &record, sizeof record);
    floats.insert(floats.end(), table.values.begin(), table.values.end());
    std::vector<float> block(VXL_GLASS_FLOATS);
    block[VXL_GLASS_IOR] = float(s.ior);
    for (size_t side = 0; side < 2; ++side) {
        block[VXL_GLASS_BACK + side] = float(glass.back[side]);
        block[VXL_GLASS_PER_MISSING + side] = float(1 / glass.missing[side]);
    }
    std::copy(glass.values.begin(), glass.values.end(), block.begin() + VXL_GLASS_TABLE);
    floats.insert(floats.end(), block.begin(), block.end());
    return floats;
}

class RoughGlass : public testing::TestWithParam<GlassSurface> {
  protected:
    struct Value {
        double white, half, density;
    };

    static std::vector<Value> values(const GlassSurface& s, const std::vector<double>& outs,
                                     const std::vector<glm::dvec3>& ins) {
        const Device device = test_device();
        const auto count = uint32_t(outs.size()), stride = (count + 15) / 16 * 16;
        std::vector<float> o(stride, 1.0f), i(3 * size_t(stride), 0.5f);
        for (uint32_t k = 0; k < count; ++k) {
            o[k] = float(outs[k]);
            for (uint32_t c = 0; c < 3; ++c) i[c * stride + k] = float(ins[k][int(c)]);
        }
        Buffer<float> found(device, "values", size_t(stride) * 3);
        program(device)
            .kernel("value_glass")
            .launch_packets(count, materials(device, s), s.inside, count,
                            Buffer<float>(device, "outs", std::span<const float>(o)),
                            Buffer<float>(device, "ins", std::span<const float>(i)), stride, found);
        const std::vector<float> v = found.read();
        std::vector<Value> result(count);
        for (uint32_t k = 0; k < count; ++k) result[k] = {v[k], v[stride + k], v[2 * stride + k]};
        return result;
    }

    /// Four arrays: the ways that paths take, and pi times the weights of their light.
    static std::vector<float> scattered(const GlassSurface& s, double out, uint32_t count,
                                        uint32_t seed, int lanes = 0) {
        const Device device = test_device(lanes);
        Buffer<float> ways(device, "ways", size_t(count) * 4);
        program(device)
            .kernel("scatter_glass")
            .launch_packets(count, materials(device, s), s.inside, count, float(out), seed, count,
                            ways);
        return ways.read();
    }

  private:
    static Program program(const Device& device) {
        Features features;
        features.rough_glass = true;
        return Program::from_text(device, kGlassSource, features.defines(device));
    }
    static Buffer<float> materials(const Device& device, const GlassSurface& s) {
        const std::vector<float> floats = floats_of(s);
        return {device, "materials", std::span<const float>(floats)};
    }
};

std::vector<GlassSurface> glass_surfaces() {
    std::vector<GlassSurface> list;
    for (const uint32_t inside : {0u, 1u})
        for (const auto& [roughness, ior] :
             {std::pair(0.3, 1.5), std::pair(0.6, 1.5), std::pair(1.0, 1.33), std::pair(0.5, 2.4)})
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
    for (const uint32_t inside : {0u, 1u})
        for (const double roughness : {0.02, 0.1, 0.3, 0.6, 1.0})
            list.push_back({roughness, 1.5, 1, 0, inside});
    list.push_back({0.4, 1.5, 0.5, 0.5, 0});
    list.push_back({0.4, 1.5, 0.5, 0.5, 1});
    list.push_back({0.6, 0.75, 1, 0, 0});
    return list;
}

class ClearGlass : public RoughGlass {};
INSTANTIATE_TEST_SUITE_P(Physical, ClearGlass, testing::ValuesIn(clear_surfaces()));

TEST_P(ClearGlass, LosesNoLightAtAnyAngle) {
    constexpr uint32_t kCount = 1u << 16;
    for (const double cosine : {0.02, 0.1, 0.4, 0.7, 1.0}) {
        const std::vector<float> ways = scattered(GetParam(), cosine, kCount, 92);
        double sum = 0, squares = 0;
        for (size_t k = 0; k < kCount; ++k) {
            const double weight = double(ways[3 * kCount + k]) / std::numbers::pi;
            sum += weight / kCount, squares += weight * weight / kCount;
        }
        const double error = std::sqrt(std::max(squares - sum * sum, 0.0) / kCount);
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
    for (const int lanes : {4, 8, 16}) EXPECT_EQ(scattered(s, 0.6, 1024, 3, lanes), one);
}

}  // namespace
}  // namespace voxelume
