// SPDX-License-Identifier: Apache-2.0
// lib/surface/field.h against the formula of shared/voxel.h, written out in double.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <random>

#include "kernels/shared/voxel.h"
#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr unsigned kFieldSeed = 20261121;

/// A decoded record: distances at corners and second differences along edges, in 1/8192 voxel.
struct Record {
    std::array<int, 8> f{};                 ///< the corner's index is x | y << 1 | z << 2
    std::array<std::array<int, 4>, 3> d{};  ///< per axis and edge: first other axis | second << 1
};

/// The ten bits of D = ±(2^e (64 + m) - 64); fails for other values.
uint32_t bits_of_edge(int d) {
    for (uint32_t e = 0; e < 8; ++e)
        for (uint32_t m = 0; m < 64; ++m)
            if (std::abs(d) == int((64 + m) << e) - 64) return 64 * e + m + (d < 0 ? 512 : 0);
    ADD_FAILURE() << d << " is no second difference of a record";
    return 0;
}

std::array<uint32_t, VXL_FIELD_WORDS> packed(const Record& r) {
    std::array<uint32_t, VXL_FIELD_WORDS> words{};
    for (size_t i = 0; i < 4; ++i) {
        words[i] = (uint32_t(r.f[2 * i]) & 0xFFFF) | uint32_t(r.f[2 * i + 1]) << 16;
        for (size_t axis = 0; axis < 3; ++axis)
            words[4 + i] |= bits_of_edge(r.d[axis][i]) << (10 * axis);
    }
    return words;
}

/// F(s) of shared/voxel.h.
double interpolant(const Record& r, const std::array<double, 3>& s) {
    double sum = 0;
    for (int i = 0; i < 8; ++i) {
        double weight = 1;
        for (int axis = 0; axis < 3; ++axis)
            weight *= i >> axis & 1 ? s[size_t(axis)] : 1 - s[size_t(axis)];
        sum += weight * r.f[size_t(i)];
    }
    for (size_t axis = 0; axis < 3; ++axis) {
        const double first = s[axis == 0 ? 1 : 0], second = s[axis == 2 ? 1 : 2];
        for (size_t e = 0; e < 4; ++e)
            sum += 0.5 * s[axis] * (1 - s[axis]) * r.d[axis][e] * (e & 1 ? first : 1 - first) *
                   (e >> 1 ? second : 1 - second);
    }
    return sum;
}

/// The derivative along an axis. F is a quadratic along it, so a central difference is exact.
double slope(const Record& r, std::array<double, 3> s, size_t axis) {
    const double at = s[axis], step = 0.125;
    s[axis] = at + step;
    const double above = interpolant(r, s);
    s[axis] = at - step;
    return (above - interpolant(r, s)) / (2 * step);
}

using Result = std::array<double, 4>;  ///< value, gradient

/// The values and gradients that the device function gives for each record at its point.
std::vector<Result> evaluate(const Device& device, const std::vector<Record>& records,
                             const std::vector<std::array<float, 3>>& points) {
    const auto count = uint32_t(records.size());
    std::vector<uint32_t> words;
    std::vector<float> coordinates(size_t(count) * 3);
    for (uint32_t i = 0; i < count; ++i) {
        for (const uint32_t word : packed(records[i])) words.push_back(word);
        for (size_t a = 0; a < 3; ++a) coordinates[a * count + i] = points[i][a];
    }
    const Program program = Program::from_text(device, R"(
#include "lib/surface/field.h"
#include "lib/lanes/work_item.h"
kernel void evaluate(uint count, global const uint* fields,
                     global const float* points, global float* results) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Field f = read_field(fields, LANES_AS_UINT(LANES_NUMBERS + (int)first));
    const lane_float x = LANES_LOAD(points, first), y = LANES_LOAD(points, count + first);
    const lane_float z = LANES_LOAD(points, 2 * count + first);
    lane_float gx, gy, gz;
    field_gradient(&f, x, y, z, &gx, &gy, &gz);
    LANES_STORE(field_value(&f, x, y, z), results, first);
    LANES_STORE(gx, results, count + first);
    LANES_STORE(gy, results, 2 * count + first);
    LANES_STORE(gz, results, 3 * count + first);
}
)");
    Buffer<float> results(device, "results", size_t(count) * 4);
    program.kernel("evaluate")
        .launch_packets(
            count, count, Buffer<uint32_t>(device, "fields", std::span<const uint32_t>(words)),
            Buffer<float>(device, "points", std::span<const float>(coordinates)), results);
    const std::vector<float> values = results.read();
    std::vector<Result> all(count);
    for (uint32_t i = 0; i < count; ++i)
        for (size_t c = 0; c < 4; ++c) all[i][c] = values[c * count + i];
    return all;
}

std::vector<std::array<float, 3>> random_points(uint32_t count, std::mt19937& random) {
    std::uniform_real_distribution<float> place(0, 1);
    std::vector<std::array<float, 3>> points(count);
    for (uint32_t i = 0; i < count; ++i)
        for (float& c : points[i]) c = i % 5 == 0 ? float(random() % 3) / 2 : place(random);
    return points;
}

int random_edge(std::mt19937& random) {
    const int size = int((64 + random() % 64) << random() % 8) - 64;
    return random() % 2 ? size : -size;
}

class FieldLanes : public testing::TestWithParam<int> {};

TEST_P(FieldLanes, AgreesWithTheFormulaInDouble) {
    std::mt19937 random(kFieldSeed);
    std::vector<Record> records(4096);
    for (Record& r : records) {
        for (int& f : r.f) f = int(random() % 65535) - 32767;
        for (auto& edges : r.d)
            for (int& d : edges) d = random_edge(random);
    }
    const auto points = random_points(4096, random);
    const auto results = evaluate(test_device(GetParam()), records, points);
    for (size_t i = 0; i < records.size(); ++i) {
        const std::array<double, 3> s = {points[i][0], points[i][1], points[i][2]};
        // The tolerance: |F| < 2^15, and each of about sixteen roundings is half a unit in the last
        // place, 2^-10.
        ASSERT_NEAR(results[i][0], interpolant(records[i], s), 1.0 / 64)
            << "seed " << kFieldSeed << " point " << i;
        for (size_t axis = 0; axis < 3; ++axis)
            ASSERT_NEAR(results[i][1 + axis], slope(records[i], s, axis), 1.0 / 16)
                << "seed " << kFieldSeed << " point " << i << " axis " << axis;
    }
}

/// q(x) = c + b·x + x·A x with integer values at integer x.
struct Quadratic {
    int c;
    std::array<int, 3> b;
    std::array<std::array<int, 3>, 3> a;  ///< used where the second index is not below the first

    template <class T>
    T operator()(const std::array<T, 3>& x) const {
        T sum = T(c);
        for (size_t i = 0; i < 3; ++i) {
            sum += T(b[i]) * x[i];
            for (size_t j = i; j < 3; ++j) sum += T(a[i][j]) * x[i] * x[j];
        }
        return sum;
    }
};

Record sampled(const Quadratic& q) {
    Record r;
    for (int i = 0; i < 8; ++i) r.f[size_t(i)] = q(std::array{i & 1, i >> 1 & 1, i >> 2});
    for (size_t axis = 0; axis < 3; ++axis)
        for (int e = 0; e < 4; ++e) {
            std::array<int, 3> node{};
            node[axis == 0 ? 1 : 0] = e & 1;
            node[axis == 2 ? 1 : 2] = e >> 1;
            const auto f = [&](int along) {
                node[axis] = along;
                return q(node);
            };
            r.d[axis][size_t(e)] = (f(1) - f(-1) - f(2) + f(0)) / 2;
        }
    return r;
}

TEST_P(FieldLanes, ReproducesPlanesAndQuadraticsExactly) {
    // Points are multiples of 1/4 and coefficients small, so no operation rounds.
    std::mt19937 random(kFieldSeed);
    const auto small = [&](int reach) { return int(random() % uint32_t(2 * reach + 1)) - reach; };
    std::vector<Quadratic> quadratics(2048);
    std::vector<Record> records;
    for (size_t i = 0; i < quadratics.size(); ++i) {
        Quadratic& q = quadratics[i];
        q.c = small(2000);
        for (int& b : q.b) b = small(3000);
        for (auto& row : q.a)
            for (int& a : row) a = i % 2 ? small(200) : 0;  // every other one is a plane
        for (size_t axis = 0; axis < 3 && i % 2; ++axis)    // D = -2a, such that records hold it
            q.a[axis][axis] = (int((64 + random() % 64) << (1 + random() % 2)) - 64) / 2;
        records.push_back(sampled(q));
    }
    std::vector<std::array<float, 3>> points(quadratics.size());
    for (auto& p : points)
        for (float& c : p) c = float(random() % 5) / 4;
    const auto results = evaluate(test_device(GetParam()), records, points);
    for (size_t i = 0; i < records.size(); ++i) {
        const std::array<double, 3> s = {points[i][0], points[i][1], points[i][2]};
        ASSERT_EQ(results[i][0], quadratics[i](s)) << "seed " << kFieldSeed << " quadratic " << i;
        for (size_t axis = 0; axis < 3; ++axis) {
            auto above = s, below = s;
            above[axis] += 0.5, below[axis] -= 0.5;
            ASSERT_EQ(results[i][1 + axis], quadratics[i](above) - quadratics[i](below))
                << "seed " << kFieldSeed << " quadratic " << i << " axis " << axis;
        }
    }
}

TEST_P(FieldLanes, HoldsTheSameBitsOnBothSidesOfASharedFace) {
    // Two neighbouring voxels along each axis share four distances and the edges of their face.
    std::mt19937 random(kFieldSeed);
    std::vector<Record> low(1536), high(1536);
    auto points = random_points(1536, random), high_points = points;
    for (size_t i = 0; i < low.size(); ++i) {
        const size_t axis = i % 3;
        for (Record* r : {&low[i], &high[i]}) {
            for (int& f : r->f) f = int(random() % 40000) - 20000;
            for (auto& edges : r->d)
                for (int& d : edges) d = random_edge(random);
        }
        for (size_t n = 0; n < 8; ++n)
            if (n >> axis & 1) high[i].f[n & ~(size_t(1) << axis)] = low[i].f[n];
        for (size_t other = 0; other < 3; ++other) {
            if (other == axis) continue;
            const size_t first = other == 0 ? 1 : 0;
            const size_t bit = first == axis ? 1 : 2;  // the bit of the edge's index for `axis`
            for (size_t e = 0; e < 4; ++e)
                if (e & bit) high[i].d[other][e & ~bit] = low[i].d[other][e];
        }
        points[i][axis] = 1, high_points[i][axis] = 0;
    }
    const Device device = test_device(GetParam());
    const auto below = evaluate(device, low, points);
    const auto above = evaluate(device, high, high_points);
    for (size_t i = 0; i < low.size(); ++i)
        ASSERT_EQ(below[i][0], above[i][0]) << "seed " << kFieldSeed << " face " << i;
}

INSTANTIATE_TEST_SUITE_P(Lanes, FieldLanes, testing::Values(1, 4, 8, 16));

}  // namespace
}  // namespace voxelume
