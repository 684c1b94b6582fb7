// SPDX-License-Identifier: Apache-2.0
// lib/light/physical.h against GGX's, Smith's, Schlick's and Kulla and Conty's formulas in double
// precision, whose albedos are integrals over facets, and against what must hold of any surface.
#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "runtime/stages/features.hpp"
#include "runtime/stages/light/material_records.hpp"
#include "tests/kernels/physical_source.hpp"
#include "tests/oracles/physical_surface.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

namespace oracle {
void PrintTo(const PhysicalValues& s, std::ostream* out) {
    *out << "metallic " << s.metallic << ", roughness " << s.roughness << ", ior " << s.ior
         << ", specular " << s.specular << ", coat " << s.coat << " of " << s.coat_roughness;
}
}  // namespace oracle

namespace {

constexpr double kPi = std::numbers::pi;

using oracle::at_cosine;
using oracle::PhysicalValues;

/// A material's record and its tables, as the stage of shading lays them out.
std::vector<float> floats_of(const PhysicalValues& s) {
    Scene scene;
    Material material;
    material.base_color = s.base;
    material.metallic = s.metallic;
    material.roughness = s.roughness;
    material.ior = float(s.ior);
    material.specular = s.specular;
    material.coat = s.coat;
    material.coat_roughness = s.coat_roughness;
    scene.materials = {material};
    const std::vector<MaterialRecord> records =
        material_records(scene, {}, Features{.physical = true});
    std::vector<float> floats(records.size() * VXL_MATERIAL_FLOATS);
    std::memcpy(floats.data(), records.data(), floats.size() * sizeof(float));
    return floats;
}

std::vector<PhysicalValues> surfaces() {
    std::vector<PhysicalValues> list;
    for (const double roughness : {0.3, 0.55, 1.0}) {
        list.push_back({0, roughness, 1.5, {0.9, 0.5, 0.1}});
        list.push_back({1, roughness, 1.5, {1, 0.7, 0.3}});
        list.push_back({0.4, roughness, 2, {0.2, 0.6, 1}});
        list.push_back({0, roughness, 1.5, {0.9, 0.5, 0.1}, 0.3});
        list.push_back({0.4, roughness, 2, {0.2, 0.6, 1}, 0.6, 0.7, 0.3});
        list.push_back({1, roughness, 1.5, {1, 0.7, 0.3}, 1, 1, 0.6});
    }
    // By default, each kind occurs with one roughness.
    if (is_exhaustive()) return list;
    std::vector<PhysicalValues> some;
    for (size_t kind = 0; kind < 6; ++kind) some.push_back(list[kind % 3 * 6 + kind]);
    return some;
}

class PhysicalSurfaces : public testing::TestWithParam<PhysicalValues> {
  protected:
    struct Value {
        glm::dvec3 value, albedo;
        double density;
    };

    std::vector<Value> values(const std::vector<double>& outs, const std::vector<glm::dvec3>& ins,
                              int lanes = 0) {
        const Device device = test_device(lanes);
        const auto count = uint32_t(outs.size()), stride = (count + 15) / 16 * 16;
        std::vector<float> o(stride, 1.0f), i(3 * size_t(stride), 0.5f);
        for (uint32_t k = 0; k < count; ++k) {
            o[k] = float(outs[k]);
            for (uint32_t c = 0; c < 3; ++c) i[c * stride + k] = float(ins[k][int(c)]);
        }
        Buffer<float> found(device, "values", size_t(stride) * 7);
        program(device)
            .kernel("value_surface")
            .launch_packets(count, materials(device), count,
                            Buffer<float>(device, "outs", std::span<const float>(o)),
                            Buffer<float>(device, "ins", std::span<const float>(i)), stride, found);
        const std::vector<float> v = found.read();
        std::vector<Value> result(count);
        for (uint32_t k = 0; k < count; ++k)
            result[k] = {{v[k], v[stride + k], v[2 * stride + k]},
                         {v[4 * stride + k], v[5 * stride + k], v[6 * stride + k]},
                         v[3 * stride + k]};
        return result;
    }

    /// Six arrays: the ways that paths take, and pi times the weights of their light.
    std::vector<float> scattered(double out, uint32_t count, uint32_t seed, int lanes = 0) {
        const Device device = test_device(lanes);
        Buffer<float> ways(device, "ways", size_t(count) * 6);
        program(device)
            .kernel("scatter_surface")
            .launch_packets(count, materials(device), count, float(out), seed, count, ways);
        return ways.read();
    }

  private:
    Program program(const Device& device) const {
        Features features;
        features.coat = GetParam().coat > 0;
        features.weak_facets = GetParam().specular < 1;
        return Program::from_text(device, kSurfaceSource, features.defines(device));
    }
    Buffer<float> materials(const Device& device) const {
        const std::vector<float> floats = floats_of(GetParam());
        return {device, "materials", std::span<const float>(floats)};
    }
};
INSTANTIATE_TEST_SUITE_P(Physical, PhysicalSurfaces, testing::ValuesIn(surfaces()));

constexpr double kCosines[] = {0.02, 0.2, 0.5, 0.85, 1};

TEST_P(PhysicalSurfaces, ReturnWhatTheFormulasSay) {
    oracle::PhysicalFormulas formulas(GetParam());
    std::mt19937 random(7);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<double> outs;
    std::vector<glm::dvec3> ins;
    for (const double cosine : kCosines)
        for (int k = 0; k < 5; ++k) {
            outs.push_back(cosine);
            ins.push_back(at_cosine(0.01 + 0.98 * any(random), 2 * kPi * any(random)));
        }
    const std::vector<Value> found = values(outs, ins);
    for (size_t k = 0; k < outs.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            const double expected = formulas.value(at_cosine(outs[k]), ins[k], c);
            // Tables of albedos are off by up to 5e-4, so what metals return later by some percent.
            ASSERT_NEAR(found[k].value[c], expected, 4e-3 * expected + 1.2e-3)
                << "out " << outs[k] << ", in " << ins[k].z << ", channel " << c;
        }
}

TEST_P(PhysicalSurfaces, ReturnAsMuchInBothDirections) {
    std::mt19937 random(8);
    std::uniform_real_distribution<double> any(0, 1);
    std::vector<double> outs, swapped_outs;
    std::vector<glm::dvec3> ins, swapped_ins;
    for (int k = 0; k < 200; ++k) {
        const double out = 0.01 + 0.99 * any(random), in = 0.01 + 0.99 * any(random);
        const double turn = kPi * any(random);
        outs.push_back(out), ins.push_back(at_cosine(in, turn));
        swapped_outs.push_back(in), swapped_ins.push_back(at_cosine(out, turn));
    }
    const std::vector<Value> there = values(outs, ins), back = values(swapped_outs, swapped_ins);
    for (size_t k = 0; k < outs.size(); ++k)
        for (int c = 0; c < 3; ++c) {
            const double forth = there[k].value[c] / ins[k].z;
            ASSERT_NEAR(back[k].value[c] / swapped_ins[k].z, forth, 2e-4 * forth)
                << outs[k] << " and " << ins[k].z;
        }
}

TEST_P(PhysicalSurfaces, ReturnTogetherTheAlbedoThatChoosesPaths) {
    constexpr uint32_t kCount = 1u << 17;
    for (const double cosine : kCosines) {
        const glm::dvec3 albedo = values({cosine}, {at_cosine(0.5)})[0].albedo;
        const std::vector<float> ways = scattered(cosine, kCount, 91);
        for (size_t c = 0; c < 3; ++c) {
            double sum = 0;
            for (size_t k = 0; k < kCount; ++k)
                sum += double(ways[(3 + c) * kCount + k]) / kPi / kCount;
            EXPECT_NEAR(sum, albedo[int(c)], 2.5e-3) << "cosine " << cosine << ", channel " << c;
        }
    }
}

std::vector<PhysicalValues> white_surfaces() {
    std::vector<PhysicalValues> list;
    for (const double roughness : {0.02, 0.05, 0.15, 0.3, 0.6, 1.0})
        for (const double metallic : {0.0, 1.0}) {
            list.push_back({metallic, roughness});
            for (const double coat_roughness : {0.0, 0.2, 1.0})
                list.push_back({metallic, roughness, 1.5, {1, 1, 1}, 0.5, 1, coat_roughness});
        }
    // By default, each roughness occurs with two of the eight other choices, and each choice with
    // some roughness.
    if (is_exhaustive()) return list;
    std::vector<PhysicalValues> some;
    for (size_t roughness = 0; roughness < 6; ++roughness)
        for (const size_t choice : {roughness, roughness + 4})
            some.push_back(list[roughness * 8 + choice % 8]);
    return some;
}

class WhiteSurfaces : public PhysicalSurfaces {};
INSTANTIATE_TEST_SUITE_P(Physical, WhiteSurfaces, testing::ValuesIn(white_surfaces()));

TEST_P(WhiteSurfaces, ReturnAllLightAtEveryAngle) {
    constexpr uint32_t kCount = 1u << 17;
    for (const double cosine : {0.002, 0.02, 0.1, 0.4, 0.8, 1.0}) {
        EXPECT_NEAR(values({cosine}, {at_cosine(0.5)})[0].albedo.x, 1, 1e-5) << cosine;
        const std::vector<float> ways = scattered(cosine, kCount, 92);
        double sum = 0, squares = 0;
        for (size_t k = 0; k < kCount; ++k) {
            const double weight = double(ways[3 * kCount + k]) / kPi;
            sum += weight / kCount, squares += weight * weight / kCount;
        }
        const double error = std::sqrt((squares - sum * sum) / kCount);
        EXPECT_LT(error, cosine < 0.1 ? 2e-2 : 2e-3) << "cosine " << cosine;
        EXPECT_NEAR(sum, 1, 5e-4 + 3 * error) << "cosine " << cosine;
    }
}

TEST_P(PhysicalSurfaces, ScatterPathsAsTheDensitySays) {
    constexpr int kRows = 8, kColumns = 12, kFine = 48;
    constexpr uint32_t kCount = 1u << 16;
    for (const double cosine : {0.15, 0.6, 0.95}) {
        std::vector<double> outs(size_t{kRows} * kColumns * kFine * kFine, cosine);
        std::vector<glm::dvec3> ins;
        for (int cell = 0; cell < kRows * kColumns; ++cell)
            for (int k = 0; k < kFine * kFine; ++k)
                ins.push_back(
                    at_cosine((cell / kColumns + (k / kFine + 0.5) / kFine) / kRows,
                              2 * kPi * (cell % kColumns + (k % kFine + 0.5) / kFine) / kColumns));
        const std::vector<Value> densities = values(outs, ins);
        std::vector<double> expected(size_t{kRows} * kColumns + 1), found(expected.size());
        expected.back() = kCount;  // those that go into the surface
        for (size_t k = 0; k < ins.size(); ++k) {
            const double share = densities[k].density * 2 * kPi / double(ins.size()) * kCount;
            expected[k / (kFine * kFine)] += share;
            expected.back() -= share;
        }
        const std::vector<float> ways = scattered(cosine, kCount, 17);
        for (size_t k = 0; k < kCount; ++k) {
            const double x = ways[k], y = ways[kCount + k], z = ways[2 * kCount + k];
            const double turn = std::atan2(y, x) / (2 * kPi);
            const int row = std::min(int(z * kRows), kRows - 1);
            const int column = std::min(int((turn - std::floor(turn)) * kColumns), kColumns - 1);
            ++found[z > 0 ? size_t(row * kColumns + column) : found.size() - 1];
        }
        double sum = 0, cells = 0;
        for (size_t cell = 0; cell < found.size(); ++cell) {
            if (expected[cell] < 8) continue;
            sum += std::pow(found[cell] - expected[cell], 2) / expected[cell];
            ++cells;
        }
        // Four standard deviations; points that are spread evenly stay far below.
        EXPECT_LT(sum, cells + 4 * std::sqrt(2 * cells)) << cells << " cells, cosine " << cosine;
    }
}

}  // namespace
}  // namespace voxelume
