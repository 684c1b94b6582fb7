// SPDX-License-Identifier: Apache-2.0
// A world that holds nothing but medium, rays through it, and the contributions of the cells that
// the rays pass.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <functional>
#include <glm/geometric.hpp>
#include <random>

#include "runtime/assets/model_frame.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/stages/medium/medium.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "tests/oracles/cell_walk.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

struct MediumRay {
    glm::dvec3 o, d;  ///< voxels, in the rays' fixed point
    float t_end = 1e6f;
    float t_hit = -1;  ///< >= 0: the ray meets a surface there
};

/// A world of `size` voxels of 0.5 x 0.25 x 1 m from (-3, -1, 2) on.
inline World medium_world(const glm::ivec3& size) {
    World world;
    world.voxel_size = {0.5, 0.25, 1};
    world.bounds.min = {-3, -1, 2};
    world.bounds.max = world.bounds.min + world.voxel_size * glm::dvec3(size);
    world.voxels = size;
    world.medium.absorption = {0.25f, 0.03125f, 1};
    return world;
}

inline int fraction_bits(const glm::ivec3& size) {
    return 24 - std::bit_width(unsigned(std::max({size.x, size.y, size.z})));
}

inline glm::dvec3 snapped(const glm::dvec3& v, int bits) {
    return glm::dvec3(std::rint(std::ldexp(v.x, bits)), std::rint(std::ldexp(v.y, bits)),
                      std::rint(std::ldexp(v.z, bits))) *
           std::ldexp(1.0, -bits);
}

/// Rays between random points of the world. Some of them run along axes or faces.
inline std::vector<MediumRay> medium_rays(const glm::ivec3& size, size_t count, unsigned seed) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(-1, 1);
    std::vector<MediumRay> rays(count);
    for (size_t i = 0; i < count; ++i) {
        MediumRay& ray = rays[i];
        glm::dvec3 d(unit(random), unit(random), unit(random));
        for (int a = 0; a < 3; ++a) {
            ray.o[a] = (unit(random) + 1) / 2 * size[a];
            if (i % 4 == 1) ray.o[a] = std::floor(ray.o[a]);        // begins on edges of cells,
            if (i % 16 == 3 && a != int(i / 16) % 3) d[a] = 0;      // along an axis,
            if (i % 16 == 7 && a != int(i / 16) % 3) d[a] *= 1e-5;  // nearly along an axis,
            if (i % 16 == 11) d[a] = d[a] < 0 ? -1 : 1;             // through corners
        }
        if (i % 16 == 3 || i % 16 == 11) ray.o = glm::floor(ray.o);
        const double largest = std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        ray.o = snapped(ray.o, fraction_bits(size));
        ray.d = snapped(d * (0.75 / largest), 22);
        if (i % 5 == 2) ray.t_hit = float((unit(random) + 1) * 30);
        if (i % 7 == 4) ray.t_end = float((unit(random) + 1) * 20);
    }
    return rays;
}

/// The density at a voxel's centre in metres, or at a voxel.
using DensityAt = std::function<double(const glm::dvec3& center, const glm::ivec3& voxel)>;

/// The sum of density times metres along a ray, over the cells that it passes, in double precision.
inline double depth_of(const World& world, const MediumRay& ray, const DensityAt& density) {
    const double t_last = double(ray.t_hit >= 0 ? ray.t_hit : ray.t_end);
    double sum = 0;
    for (const oracle::CrossedCell& crossed :
         oracle::cells_crossed(ray.o, ray.d, world.voxels, fraction_bits(world.voxels))) {
        if (crossed.t_in >= t_last) break;
        const glm::dvec3 center =
            world.bounds.min + world.voxel_size * (glm::dvec3(crossed.cell) + 0.5);
        sum += density(center, crossed.cell) * (std::min(crossed.t_out, t_last) - crossed.t_in);
    }
    return sum * glm::length(ray.d * world.voxel_size);
}

/// A batch of rays on a device, and the medium's kernels for them.
class MediumBatch {
  public:
    MediumBatch(const World& world, const std::vector<MediumRay>& rays, int lanes = 0,
                Features more = {})
        : device(test_device(lanes)), count(uint32_t(rays.size())) {
        pyramid.frame = world_frame(world);
        features = more;
        features.medium = true;
        features.medium_grid = has_density(world.medium);
        batch.stride = (count + 15) / 16 * 16;
        const size_t stride = batch.stride;
        std::vector<float> components(VXL_RAY_COMPONENTS * stride, 0);
        std::vector<uint32_t> hits(VXL_HIT_PRIMITIVE * stride, VXL_NO_VOXEL);
        for (size_t i = 0; i < stride; ++i) components[VXL_RAY_END * stride + i] = -1;
        for (size_t i = 0; i < count; ++i) {
            for (int a = 0; a < 3; ++a) {
                components[(VXL_RAY_OX + a) * stride + i] = float(rays[i].o[a]);
                components[(VXL_RAY_DX + a) * stride + i] = float(rays[i].d[a]);
            }
            components[VXL_RAY_END * stride + i] = rays[i].t_end;
            if (rays[i].t_hit < 0) continue;
            hits[VXL_HIT_T * stride + i] = std::bit_cast<uint32_t>(rays[i].t_hit);
            hits[VXL_HIT_VOXEL * stride + i] = 0;
        }
        batch.rays = Buffer<float>(device, "rays", std::span<const float>(components));
        batch.hits = Buffer<uint32_t>(device, "hits", std::span<const uint32_t>(hits));
        batch.radiance = Buffer<float>(device, "radiance", 3 * stride);
        const MaterialRecord none{};
        materials = Buffer<MaterialRecord>(device, "materials", std::span(&none, 1));
        environment.absorption = {world.medium.absorption.x, world.medium.absorption.y,
                                  world.medium.absorption.z, 0};
        environment.color = {world.medium.color.x, world.medium.color.y, world.medium.color.z, 0};
        world_ = world;
    }

    MediumStage stage() const { return {device, features, world_, environment, materials}; }

    /// The rays' radiance after the medium when `behind` comes from their ends: three planes,
    /// `batch.stride` apart.
    std::vector<float> sight(float behind) {
        batch.radiance.fill(behind);
        stage().sight(pyramid, batch, count);
        return batch.radiance.read();
    }

    Device device;
    uint32_t count;
    Features features;
    Pyramid pyramid;
    RayBatch batch;
    Environment environment{};
    Buffer<MaterialRecord> materials;

  private:
    World world_;
};

}  // namespace voxelume
