// SPDX-License-Identifier: Apache-2.0
// Rays at analytic solids on the device, for tests of the solids' surfaces.
#pragma once

#include <cmath>
#include <random>
#include <vector>

#include "runtime/geometry/solid/solid_program.hpp"
#include "runtime/opencl/program.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/support/solid_cases.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

struct Ray {
    glm::vec3 origin, direction;

    oracle::Vector at(long double t) const {
        return oracle::Vector(origin) + oracle::Vector(direction) * t;
    }
};

struct Hit {
    float t = INFINITY;
    glm::vec3 normal{0};
};

/// Runs hit_solids() and solid_normals() with a given number of lanes.
class HitProbe {
  public:
    explicit HitProbe(int lanes)
        : device_(test_device(lanes)), code_(Program::from_text(device_, R"(
#include "lib/solid/solid_surface.h"
#include "lib/lanes/work_item.h"
kernel void probe(global const SolidShape* solids, global const float* rays, uint count,
                  int from_solid, global const uint* numbers, global float* hits) {
    const uint i = work_item() * VXL_LANES;
    if (i >= count) return;
    SolidRay ray;
    ray.ox = LANES_LOAD(rays, i);
    ray.oy = LANES_LOAD(rays, count + i);
    ray.oz = LANES_LOAD(rays, 2u * count + i);
    ray.dx = LANES_LOAD(rays, 3u * count + i);
    ray.dy = LANES_LOAD(rays, 4u * count + i);
    ray.dz = LANES_LOAD(rays, 5u * count + i);
    lane_float t = (lane_float)INFINITY;
    const lane_uint number = LANES_LOAD(numbers, i);
    const lane_int known = (lane_int)from_solid;
    const lane_int inside = go_inside(solids, number, &ray, known);
    const lane_int hit = hit_solids(solids, number, &ray, (lane_float)0.0f, (lane_float)0.0f, known, inside,
                                    (lane_int)-1, &t);
    const SolidPoint n = solid_normals(solids, number, &ray, t, hit);
    LANES_STORE(t, hits, i);
    LANES_STORE(n.x, hits, count + i);
    LANES_STORE(n.y, hits, 2u * count + i);
    LANES_STORE(n.z, hits, 3u * count + i);
}
)")) {}

    std::vector<Hit> operator()(const SolidProgram& program, std::vector<Ray> rays,
                                bool from_solid = false, std::vector<uint32_t> numbers = {}) const {
        const size_t asked = rays.size(), n = (asked + 15) / 16 * 16;
        rays.resize(n, rays.back());
        numbers.resize(n, numbers.empty() ? 0 : numbers.back());
        std::vector<float> columns(6 * n);
        for (size_t i = 0; i < n; ++i)
            for (int axis = 0; axis < 3; ++axis) {
                columns[axis * n + i] = rays[i].origin[axis];
                columns[(3 + axis) * n + i] = rays[i].direction[axis];
            }
        const Buffer<uint32_t> solids(device_, "solids", program.words());
        const Buffer<float> in(device_, "rays", columns), out(device_, "hits", 4 * n);
        const Buffer<uint32_t> which(device_, "numbers", numbers);
        code_.kernel("probe").launch(WorkItem::heavy, n / device_.lanes(), solids, in,
                                     static_cast<uint32_t>(n), from_solid ? -1 : 0, which, out);
        const std::vector<float> result = out.read();
        std::vector<Hit> hits(asked);
        for (size_t i = 0; i < asked; ++i)
            hits[i] = {result[i], {result[n + i], result[2 * n + i], result[3 * n + i]}};
        return hits;
    }

  private:
    Device device_;
    Program code_;
};

inline const HitProbe& probe() {
    static const HitProbe it(0);
    return it;
}

/// A grid of 64x56x48 voxels of one metre, with the solids' origin inside.
inline GridFrame ray_frame() {
    GridFrame frame;
    frame.origin = {-31.375, -28.25, -24.5};
    frame.size = {64, 56, 48};
    return frame;
}

inline glm::dmat4 grid_from_solid() {
    return moved(rational_rotation(1, 2, 3, 4), -ray_frame().origin);
}

/// Rays as the tracer receives them: origins in the grid are multiples of 2^-18, directions of
/// 2^-22.
inline std::vector<Ray> random_rays(unsigned seed, size_t count) {
    std::mt19937 random(seed);
    std::uniform_real_distribution<double> unit(0, 1);
    std::vector<Ray> rays;
    for (size_t i = 0; i < count; ++i) {
        const glm::dvec3 from(64 * unit(random), 56 * unit(random), 48 * unit(random));
        glm::dvec3 to = -ray_frame().origin;
        for (int axis = 0; axis < 3; ++axis) to[axis] += 26 * unit(random) - 13;
        glm::dvec3 d = to - from;
        d *= (0.5 + 0.5 * unit(random)) / std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)});
        rays.push_back({glm::vec3(glm::round(from * 262144.0) / 262144.0),
                        glm::vec3(glm::round(d * 4194304.0) / 4194304.0)});
    }
    return rays;
}

inline Solid shape(SolidKind kind, const glm::dvec3& at) {
    Solid s;
    s.kind = kind;
    s.parent_from_solid = moved(glm::dmat4(1), at);
    return s;
}

}  // namespace voxelume
