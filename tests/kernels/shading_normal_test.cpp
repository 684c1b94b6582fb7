// SPDX-License-Identifier: Apache-2.0
// lib/surface/shading_normal.h against double precision: normals from their codes, and the
// directions that shading normals reflect to.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>
#include <random>

#include "runtime/geometry/mesh_normals.hpp"
#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kNormals = 4096;

constexpr const char* kNormalSource = R"(
#include "lib/lanes/work_item.h"
#include "lib/surface/shading_normal.h"
kernel void unpack(uint count, global const uint* codes, global float* normals) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    store_vector(unit(unpack_normal(LANES_LOAD(codes, first))), normals, count, first);
}
kernel void reflect(uint count, global const float* ways, global const float* faces,
                    global const float* normals, global float* used) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Vector way = load_vector(ways, count, first);
    const Vector face = load_vector(faces, count, first);
    store_vector(reflecting_normal(way, face, load_vector(normals, count, first)), used, count,
                 first);
}
)";

glm::dvec3 random_direction(std::mt19937& random) {
    std::normal_distribution<double> value;
    return glm::normalize(glm::dvec3(value(random), value(random), value(random)));
}

/// Vectors as kernels read them.
class Vectors {
  public:
    Vectors() : values_(3 * kNormals) {}
    explicit Vectors(const Buffer<float>& buffer) : values_(buffer.read()) {}

    void set(uint32_t i, const glm::dvec3& v) {
        for (uint32_t a = 0; a < 3; ++a) values_[a * kNormals + i] = float(v[int(a)]);
    }
    glm::dvec3 operator[](uint32_t i) const {
        return {values_[i], values_[kNormals + i], values_[2 * kNormals + i]};
    }
    Buffer<float> upload(const Device& device) const {
        return {device, "vectors", std::span<const float>(values_)};
    }

  private:
    std::vector<float> values_;
};

TEST(ShadingNormal, OfACodeIsThatOfTheHost) {
    const Device device = test_device();
    std::mt19937 random(11);
    std::vector<uint32_t> codes = {packed_normal({0, 0, 1}),  packed_normal({0, 0, -1}),
                                   packed_normal({-1, 0, 0}), packed_normal({0, 1, 0}),
                                   packed_normal({1, -2, 0}), packed_normal({-1, -1, -1})};
    while (codes.size() < kNormals) codes.push_back(packed_normal(random_direction(random)));
    const Buffer<float> out(device, "normals", 3 * kNormals);
    Program::from_text(device, kNormalSource, {})
        .kernel("unpack")
        .launch_packets(kNormals, kNormals,
                        Buffer<uint32_t>(device, "codes", std::span<const uint32_t>(codes)), out);
    const Vectors normals(out);
    for (uint32_t i = 0; i < kNormals; ++i)
        ASSERT_LT(glm::distance(normals[i], unpacked_normal(codes[i])), 3e-7) << i;
}

TEST(ShadingNormal, ReflectsToTheSideOfTheSurfaceThatTheRayComesFrom) {
    const Device device = test_device();
    std::mt19937 random(12);
    Vectors ways, faces, normals;
    for (uint32_t i = 0; i < kNormals; ++i) {
        const glm::dvec3 face = random_direction(random);
        glm::dvec3 way = random_direction(random), normal = random_direction(random);
        if (glm::dot(way, face) > 0) way = -way;
        if (glm::dot(normal, face) < 0) normal = -normal;
        if (i % 2 == 0) normal = glm::normalize(face + 0.2 * normal);
        ways.set(i, way), faces.set(i, face), normals.set(i, normal);
    }
    const Buffer<float> out(device, "normals", 3 * kNormals);
    Program::from_text(device, kNormalSource, {})
        .kernel("reflect")
        .launch_packets(kNormals, kNormals, ways.upload(device), faces.upload(device),
                        normals.upload(device), out);
    const Vectors used(out);
    int bent = 0;
    for (uint32_t i = 0; i < kNormals; ++i) {
        const glm::dvec3 way = ways[i], n = used[i], face = faces[i];
        const double above = -glm::dot(way, face);
        const auto mirrored = [&](const glm::dvec3& by) { return glm::reflect(way, by); };
        EXPECT_NEAR(glm::length(n), 1, 1e-6) << i;
        EXPECT_GT(glm::dot(n, -way), 0) << i;
        EXPECT_GE(glm::dot(mirrored(n), face), 0.98 * std::min(0.9 * above, 0.01) - 1e-6) << i;
        const double asked = glm::dot(mirrored(normals[i]), face);
        if (asked > std::min(0.9 * above, 0.01) + 1e-6)
            EXPECT_EQ(n, normals[i]) << i << " needs no correction";
        else
            ++bent;
    }
    EXPECT_GT(bent, 500);
}

}  // namespace
}  // namespace voxelume
