// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/inward_rays.hpp"

#include <algorithm>
#include <glm/common.hpp>
#include <glm/vector_relational.hpp>
#include <numbers>

namespace voxelume {
namespace {

constexpr double kPi = std::numbers::pi;

glm::dvec3 point_inside(const Ring& ring, double share, StressRandom& random) {
    return ring.point(random.uniform(0, 2 * kPi), random.uniform(0, 2 * kPi),
                      random.uniform(0, share));
}

/// True if a point lies so deep inside the ring that no surface reaches it.
bool is_deep(const Ring& ring, const glm::dvec3& p, double share) {
    return ring.outside(p) <= (share - 1) * 8;
}

/// A ray to a point, from an origin in fixed point.
InwardRay ray_to(const glm::dvec3& target, const std::array<int64_t, 3>& origin,
                 const FixedGrid& grid) {
    InwardRay inward;
    inward.ray.origin = origin;
    glm::dvec3 way;
    for (size_t a = 0; a < 3; ++a)
        way[int(a)] = target[int(a)] - double(origin[a]) / double(grid.unit());
    const double longest = std::max({std::abs(way.x), std::abs(way.y), std::abs(way.z)});
    inward.inside = std::exp2(std::ceil(std::log2(longest)));
    for (size_t a = 0; a < 3; ++a)
        inward.ray.direction[a] = std::llround(way[int(a)] / inward.inside * double(kDirectionOne));
    return inward;
}

/// A random point on a side of the grid that lies across axis `face`.
std::array<int64_t, 3> point_on_side(const FixedGrid& grid, size_t face, StressRandom& random) {
    std::array<int64_t, 3> point;
    for (size_t a = 0; a < 3; ++a) {
        const int64_t side = grid.size[int(a)] * grid.unit();
        point[a] = a == face ? int64_t(random.below(2)) * side : random.between(0, side);
    }
    return point;
}

InwardRay from_a_side(const Ring& ring, const FixedGrid& grid, double share, StressRandom& random) {
    const glm::dvec3 target = point_inside(ring, share, random);
    const size_t face = random.below(3);
    return ray_to(target, point_on_side(grid, face, random), grid);
}

/// A ray from outside through half-integer points to a lattice point inside: it passes corners and
/// edges.
InwardRay through_corners(const Ring& ring, const FixedGrid& grid, double share,
                          StressRandom& random) {
    while (true) {
        glm::dvec3 target = glm::round(point_inside(ring, share, random));
        if (random.below(3) == 0) target[int(random.below(3))] += 0.5;
        glm::ivec3 quarters;
        for (int a = 0; a < 3; ++a) quarters[a] = int(random.between(-4, 4));
        const glm::ivec3 size = glm::abs(quarters);
        if (std::max({size.x, size.y, size.z}) < 2 || !is_deep(ring, target, share)) continue;
        const glm::dvec3 step = glm::dvec3(quarters) / 4.0;
        glm::dvec3 origin = target;
        InwardRay inward;
        const auto in_grid = [&](const glm::dvec3& p) {
            return glm::all(glm::greaterThanEqual(p, glm::dvec3(0))) &&
                   glm::all(glm::lessThanEqual(p, glm::dvec3(grid.size)));
        };
        while (in_grid(origin - step)) origin -= step, inward.inside += 1;
        if (ring.outside(origin) < 1.5) continue;
        for (size_t a = 0; a < 3; ++a) {
            inward.ray.origin[a] = std::llround(origin[int(a)] * double(grid.unit()));
            inward.ray.direction[a] = quarters[int(a)] * (kDirectionOne / 4);
        }
        return inward;
    }
}

/// A random shift of up to half of `spread` along each axis.
glm::dvec3 random_shift(double spread, StressRandom& random) {
    glm::dvec3 shift;
    for (int a = 0; a < 3; ++a) shift[a] = random.uniform(-0.5, 0.5) * spread;
    return shift;
}

}  // namespace

glm::dvec3 Ring::point(double around, double across, double share) const {
    const double r = radius + share * tube * std::cos(across);
    glm::dvec3 q(r * std::cos(around), r * std::sin(around),
                 share * tube * std::sin(across) / flatness);
    for (int i = 0; i < turns; ++i) q = {q.y, q.z, q.x};
    return center + q;
}

double Ring::outside(const glm::dvec3& p) const {
    glm::dvec3 q = p - center;
    for (int i = 0; i < turns; ++i) q = {q.z, q.x, q.y};
    return (std::hypot(std::hypot(q.x, q.y) - radius, q.z * flatness) - tube) /
           std::max(1.0, flatness);
}

Mesh Ring::mesh() const {
    constexpr uint32_t kAround = 96, kAcross = 48;
    Mesh mesh;
    for (uint32_t i = 0; i < kAround; ++i)
        for (uint32_t j = 0; j < kAcross; ++j) {
            mesh.positions.emplace_back(point(2 * kPi * i / kAround, 2 * kPi * j / kAcross, 1));
            const uint32_t a = i * kAcross, b = (i + 1) % kAround * kAcross, k = (j + 1) % kAcross;
            mesh.triangles.emplace_back(a + j, b + j, b + k);
            mesh.triangles.emplace_back(a + j, b + k, a + k);
        }
    return mesh;
}

InwardRay inward_ray(const Ring& ring, const FixedGrid& grid, double share, StressRandom& random) {
    return random.below(2) ? from_a_side(ring, grid, share, random)
                           : through_corners(ring, grid, share, random);
}

std::array<InwardRay, VXL_BEAM_RAYS> inward_tile(const Ring& ring, const FixedGrid& grid,
                                                 double share, StressRandom& random) {
    glm::dvec3 middle = point_inside(ring, share, random);
    while (!is_deep(ring, middle, share)) middle = point_inside(ring, share, random);
    const size_t face = random.below(3);
    const std::array<int64_t, 3> start = point_on_side(grid, face, random);
    const double origin_spread = random.below(2) ? std::exp2(random.uniform(-6, 4)) : 0;
    const double target_spread = std::exp2(random.uniform(-6, 5));
    std::array<InwardRay, VXL_BEAM_RAYS> tile;
    for (InwardRay& inward : tile) {
        std::array<int64_t, 3> origin = start;
        const glm::dvec3 shift = random_shift(origin_spread, random) * double(grid.unit());
        for (size_t a = 0; a < 3; ++a)
            if (a != face)
                origin[a] = std::clamp(start[a] + int64_t(std::llround(shift[int(a)])), int64_t{0},
                                       grid.size[int(a)] * grid.unit());
        double spread = target_spread;
        glm::dvec3 target = middle + random_shift(spread, random);
        while (!is_deep(ring, target, share)) target = middle + random_shift(spread *= 0.5, random);
        inward = ray_to(target, origin, grid);
    }
    return tile;
}

glm::dvec3 point_at(const FixedGrid& grid, const FixedRay& ray, double t) {
    glm::dvec3 point;
    for (size_t a = 0; a < 3; ++a)
        point[int(a)] = double(ray.origin[a]) / double(grid.unit()) +
                        double(ray.direction[a]) / double(kDirectionOne) * t;
    return point;
}

}  // namespace voxelume
