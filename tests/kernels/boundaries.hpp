// SPDX-License-Identifier: Apache-2.0
// lib/light/optics.h on a device: rays at boundaries of media.
#pragma once

#include <glm/vec3.hpp>
#include <vector>

#include "runtime/opencl/program.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

inline constexpr const char* kOpticsSource = R"(
#include "lib/light/optics.h"
#include "lib/lanes/work_item.h"
kernel void refract_rays(uint count, uint stride, global const float* etas,
                         global const float* directions, global const float* normals,
                         global float* bent) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const lane_float eta = LANES_LOAD(etas, first);
    const Vector v = load_vector(directions, stride, first);
    const Vector n = load_vector(normals, stride, first);
    const lane_float c = clamp(-dot_product(v, n), 0.0f, 1.0f);
    const Refraction bend = refraction_at(eta, c);
    store_vector(refracted_direction(v, n, eta, c, &bend), bent, stride, first);
}
kernel void meet_boundaries(uint count, uint stride, global const float* etas,
                            global const float* cosines, global float* results) {
    const uint first = work_item() * VXL_LANES;
    if (first >= count) return;
    const Refraction r = refraction_at(LANES_LOAD(etas, first), LANES_LOAD(cosines, first));
    LANES_STORE(LANES_FLOAT(r.total), results, first);
    LANES_STORE(r.cosine, results, stride + first);
    LANES_STORE(r.reflected, results, 2 * stride + first);
    LANES_STORE(r.refracted, results, 3 * stride + first);
}
)";

/// A ray at a boundary; `normal` points against `direction`.
struct Boundary {
    double eta;
    glm::dvec3 direction, normal;
};

struct Met {
    bool total;
    float cosine, reflected, refracted;
    bool operator==(const Met&) const = default;
};

/// Kernels that call the functions, on a device.
class Boundaries {
  public:
    explicit Boundaries(int lanes = 0)
        : device_(test_device(lanes)), program_(Program::from_text(device_, kOpticsSource, {})) {}

    std::vector<glm::dvec3> refracted(const std::vector<Boundary>& boundaries) const {
        const auto count = uint32_t(boundaries.size()), stride = (count + 15) / 16 * 16;
        std::vector<float> etas(stride, 1), directions(3 * stride), normals(3 * stride);
        for (uint32_t i = 0; i < count; ++i) {
            etas[i] = float(boundaries[i].eta);
            for (uint32_t a = 0; a < 3; ++a) {
                directions[a * stride + i] = float(boundaries[i].direction[int(a)]);
                normals[a * stride + i] = float(boundaries[i].normal[int(a)]);
            }
        }
        Buffer<float> bent(device_, "bent", 3 * stride);
        program_.kernel("refract_rays")
            .launch_packets(count, count, stride, input(etas), input(directions), input(normals),
                            bent);
        const std::vector<float> values = bent.read();
        std::vector<glm::dvec3> result;
        for (uint32_t i = 0; i < count; ++i)
            result.push_back({values[i], values[stride + i], values[2 * stride + i]});
        return result;
    }

    std::vector<Met> met(const std::vector<float>& etas, const std::vector<float>& cosines) const {
        const auto count = uint32_t(etas.size()), stride = (count + 15) / 16 * 16;
        std::vector<float> padded_etas = etas, padded_cosines = cosines;
        padded_etas.resize(stride, 1);
        padded_cosines.resize(stride, 1);
        Buffer<float> results(device_, "results", 4 * stride);
        program_.kernel("meet_boundaries")
            .launch_packets(count, count, stride, input(padded_etas), input(padded_cosines),
                            results);
        const std::vector<float> values = results.read();
        std::vector<Met> all;
        for (uint32_t i = 0; i < count; ++i)
            all.push_back({values[i] != 0, values[stride + i], values[2 * stride + i],
                           values[3 * stride + i]});
        return all;
    }

  private:
    Buffer<float> input(const std::vector<float>& values) const {
        return {device_, "input", std::span<const float>(values)};
    }

    Device device_;
    Program program_;
};

}  // namespace voxelume
