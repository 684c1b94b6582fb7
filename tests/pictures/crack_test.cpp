// SPDX-License-Identifier: Apache-2.0
// Closed smooth surfaces have no cracks: every ray from outside to a point inside hits the surface
// on its way.
#include <gtest/gtest.h>

#include <bit>
#include <cmath>
#include <random>

#include "runtime/stages/index/index.hpp"
#include "runtime/stages/trace/trace.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/support/test_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

constexpr unsigned kSeed = 20261121;
constexpr uint32_t kRays = 100000;
constexpr double kPi = std::numbers::pi;

/// A ring with an elliptic tube around z, in voxels, and its mesh.
struct Ring {
    glm::dvec3 center{43.3, 41.1, 22.6};
    double radius = 25.2, tube = 11.4, flatness = 1.3;

    /// A measure that is less than -1 about a voxel or more inside, and more than 1 outside.
    double outside(const glm::dvec3& p) const {
        const glm::dvec3 q = p - center;
        return std::hypot(std::hypot(q.x, q.y) - radius, q.z * flatness) - tube;
    }
    glm::dvec3 point(double around, double across, double share) const {
        const double r = radius + share * tube * std::cos(across);
        return center + glm::dvec3(r * std::cos(around), r * std::sin(around),
                                   share * tube * std::sin(across) / flatness);
    }
    Mesh mesh() const {
        return closed_grid(96, 48, [&](double u, double v) { return point(u, v, 1); });
    }
};

const glm::ivec3 kSize(87, 83, 45);

/// A ray in the walk's fixed point, and the t of a point inside the surface.
struct CrackRay {
    glm::dvec3 origin, direction;
    double inside;
};

double uniform(std::mt19937& random) {
    return double(random()) / 4294967296.0;
}

/// A ray from a face of the grid towards a point near the middle of the tube.
CrackRay ray_from_outside(const Ring& ring, double unit, std::mt19937& random) {
    const glm::dvec3 target =
        ring.point(2 * kPi * uniform(random), 2 * kPi * uniform(random), 0.8 * uniform(random));
    CrackRay ray;
    for (int a = 0; a < 3; ++a)
        ray.origin[a] = std::round(uniform(random) * kSize[a] / unit) * unit;
    const int face = int(random() % 3);
    ray.origin[face] = random() % 2 ? kSize[face] : 0;
    const glm::dvec3 way = target - ray.origin, size = glm::abs(way);
    const double scale = std::exp2(-std::ceil(std::log2(std::max({size.x, size.y, size.z}))));
    const double step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
    for (int a = 0; a < 3; ++a) ray.direction[a] = std::round(way[a] * scale / step) * step;
    ray.inside = 1 / scale;
    return ray;
}

/// A ray through lattice points or edges: from a lattice point deep inside it goes backwards, along
/// a direction of few bits, to half-integer places until it is outside.
std::optional<CrackRay> ray_through_corners(const Ring& ring, std::mt19937& random) {
    glm::dvec3 target = glm::round(
        ring.point(2 * kPi * uniform(random), 2 * kPi * uniform(random), 0.7 * uniform(random)));
    target[int(random() % 3)] += random() % 3 ? 0 : 0.5;
    glm::dvec3 d;
    for (int a = 0; a < 3; ++a) d[a] = double(int(random() % 9) - 4) / 4;
    const glm::dvec3 size = glm::abs(d);
    if (std::max({size.x, size.y, size.z}) < 0.5 || ring.outside(target) > -1.5) return {};
    CrackRay ray{target, d, 0};
    const auto in_grid = [&](const glm::dvec3& p) {
        return glm::all(glm::greaterThanEqual(p, glm::dvec3(0))) &&
               glm::all(glm::lessThanEqual(p, glm::dvec3(kSize)));
    };
    while (in_grid(ray.origin - d)) ray.origin -= d, ray.inside += 1;
    if (ring.outside(ray.origin) < 1.5) return {};
    return ray;
}

std::vector<CrackRay> rays_at(const Ring& ring, double unit) {
    std::mt19937 random(kSeed);
    std::vector<CrackRay> rays;
    while (rays.size() < kRays) {
        if (rays.size() % 2) {
            rays.push_back(ray_from_outside(ring, unit, random));
        } else if (const auto ray = ray_through_corners(ring, random)) {
            rays.push_back(*ray);
        }
    }
    return rays;
}

/// The t of every ray's hit; infinite for a miss.
std::vector<float> hit_times(const Device& device, const Pyramid& pyramid,
                             const std::vector<CrackRay>& rays) {
    const uint32_t stride = (uint32_t(rays.size()) + 15) / 16 * 16;
    std::vector<float> values(size_t(stride) * VXL_RAY_COMPONENTS, -1.0f);
    for (uint32_t i = 0; i < rays.size(); ++i) {
        for (uint32_t a = 0; a < 3; ++a) {
            values[(VXL_RAY_OX + a) * stride + i] = float(rays[i].origin[int(a)]);
            values[(VXL_RAY_DX + a) * stride + i] = float(rays[i].direction[int(a)]);
        }
        values[VXL_RAY_END * stride + i] = INFINITY;
    }
    RayBatch batch;
    batch.stride = stride;
    batch.rays = Buffer<float>(device, "rays", std::span<const float>(values));
    batch.hits = Buffer<uint32_t>(device, "hits", size_t(stride) * VXL_HIT_COMPONENTS);
    TraceStage(device, features_of(pyramid)).closest(pyramid, batch, uint32_t(rays.size()));
    const std::vector<uint32_t> words = batch.hits.read();
    std::vector<float> times;
    for (uint32_t i = 0; i < rays.size(); ++i)
        times.push_back(words[VXL_HIT_VOXEL * stride + i] == VXL_NO_VOXEL
                            ? INFINITY
                            : std::bit_cast<float>(words[VXL_HIT_T * stride + i]));
    return times;
}

class Cracks : public testing::TestWithParam<std::tuple<int, Surface>> {};

TEST_P(Cracks, NoRayReachesAPointInside) {
    const auto [lanes, surface] = GetParam();
    const Device device = test_device(lanes);
    const Ring ring;
    GridFrame frame;
    frame.size = kSize;
    VoxelizeOptions options;
    options.surface = surface;
    Voxelizer voxelizer(device);
    const Pyramid pyramid =
        build_index(device, voxelizer.voxelize(ring.mesh(), glm::dmat4(1), frame, options));
    const auto rays = rays_at(ring, 1 / double(shape_of(pyramid).fixed_point));
    const auto times = hit_times(device, pyramid, rays);
    size_t leaks = 0;
    for (size_t i = 0; i < rays.size(); ++i) {
        if (times[i] < rays[i].inside) continue;
        if (++leaks <= 5)
            ADD_FAILURE() << "seed " << kSeed << " ray " << i << " from " << rays[i].origin.x << ' '
                          << rays[i].origin.y << ' ' << rays[i].origin.z << " along "
                          << rays[i].direction.x << ' ' << rays[i].direction.y << ' '
                          << rays[i].direction.z << " hits at " << times[i];
    }
    EXPECT_EQ(leaks, 0u) << "of " << rays.size();
}

INSTANTIATE_TEST_SUITE_P(Ways, Cracks,
                         testing::Combine(testing::Values(0, 1),
                                          testing::Values(Surface::smooth, Surface::exact)));

}  // namespace
}  // namespace voxelume
