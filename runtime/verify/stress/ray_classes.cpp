// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/stress/ray_classes.hpp"

#include <algorithm>
#include <cstdlib>

#include "runtime/verify/stress/stress_random.hpp"

namespace voxelume {
namespace {

using Components = std::array<int64_t, 3>;

int64_t largest(const Components& d) {
    return std::max({std::abs(d[0]), std::abs(d[1]), std::abs(d[2])});
}

Components any_origin(const FixedGrid& grid, StressRandom& random) {
    Components o;
    for (int a = 0; a < 3; ++a)
        o[size_t(a)] = random.between(0, int64_t(grid.size[a]) * grid.unit());
    return o;
}

Components any_direction(StressRandom& random) {
    Components d;
    for (int64_t& c : d) c = random.between(-kDirectionOne, kDirectionOne);
    if (largest(d) < kDirectionOne / 2)
        d[random.below(3)] = random.sign() * random.between(kDirectionOne / 2, kDirectionOne);
    return d;
}

/// The direction doubled, without loss, until its largest component is in [1/2, 1].
Components scaled_up(Components d) {
    while (largest(d) < kDirectionOne / 2)
        for (int64_t& c : d) c *= 2;
    return d;
}

/// A ray from one half-integer lattice point to another.
FixedRay between_lattice_points(const FixedGrid& grid, StressRandom& random) {
    FixedRay ray;
    const int64_t half = grid.unit() / 2;
    for (size_t a = 0; a < 3; ++a) {
        const int64_t half_steps = 2 * int64_t(grid.size[int(a)]);
        const int64_t from = random.between(0, half_steps);
        // Most targets are close, because these rays have more ties.
        const int64_t reach = random.below(4) == 0 ? half_steps : 16;
        const int64_t to =
            random.between(std::max<int64_t>(0, from - reach), std::min(half_steps, from + reach));
        ray.origin[a] = from * half;
        ray.direction[a] = to - from;
    }
    if (largest(ray.direction) == 0) ray.direction[random.below(3)] = random.sign();
    ray.direction = scaled_up(ray.direction);
    return ray;
}

FixedRay in_a_plane(const FixedGrid& grid, StressRandom& random) {
    FixedRay ray{any_origin(grid, random), any_direction(random)};
    const size_t axis = random.below(3);
    const int64_t side = int64_t(grid.size[int(axis)]) * grid.unit();
    const int64_t plane = random.between(0, grid.size[int(axis)]) * grid.unit();
    ray.origin[axis] = std::clamp<int64_t>(plane + random.between(-2, 2), 0, side);
    ray.direction[axis] = random.between(-4, 4);
    if (largest(ray.direction) < kDirectionOne / 2)
        ray.direction[(axis + 1) % 3] =
            random.sign() * random.between(kDirectionOne / 2, kDirectionOne);
    return ray;
}

/// A ray through a lattice point or a point on a lattice line. It begins up to as far back as the
/// grid extends.
FixedRay through_a_corner(const FixedGrid& grid, StressRandom& random) {
    FixedRay ray;
    ray.direction = any_direction(random);
    // With few bits some rays pass exactly through the corner, with all bits within half a unit of
    // it.
    const int64_t step = int64_t{1} << random.below(23);
    for (int64_t& c : ray.direction) c = c / step * step;
    if (largest(ray.direction) < kDirectionOne / 2)
        ray.direction[random.below(3)] = random.sign() * kDirectionOne;
    const size_t free_axis = random.below(6);
    Components target;
    for (size_t a = 0; a < 3; ++a)
        target[a] = a == free_axis ? random.between(0, int64_t(grid.size[int(a)]) * grid.unit())
                                   : random.between(0, grid.size[int(a)]) * grid.unit();
    int64_t way = int64_t{1} << 40;
    for (size_t a = 0; a < 3; ++a) {
        const int64_t d = ray.direction[a], side = int64_t(grid.size[int(a)]) * grid.unit();
        if (d != 0)
            way =
                std::min(way, (d > 0 ? target[a] : side - target[a]) * kDirectionOne / std::abs(d));
    }
    way = random.between(0, way);
    const bool exact = random.below(2) == 0;
    if (exact) way -= way % (kDirectionOne / step);  // makes every component whole
    for (size_t a = 0; a < 3; ++a)
        ray.origin[a] = std::clamp<int64_t>(target[a] - way * ray.direction[a] / kDirectionOne +
                                                (exact ? 0 : random.between(-1, 1)),
                                            0, int64_t(grid.size[int(a)]) * grid.unit());
    return ray;
}

FixedRay along_an_axis(const FixedGrid& grid, StressRandom& random) {
    FixedRay ray{any_origin(grid, random), {}};
    const size_t axis = random.below(3);
    for (size_t a = 0; a < 3; ++a) {
        ray.direction[a] = random.below(3) == 0 ? 0 : random.between(-8, 8);
        if (random.below(4) == 0)
            ray.origin[a] = random.between(0, grid.size[int(a)]) * grid.unit();
    }
    ray.direction[axis] = random.sign() * (kDirectionOne - random.between(0, 3));
    return ray;
}

FixedRay along_a_diagonal(const FixedGrid& grid, StressRandom& random) {
    FixedRay ray{any_origin(grid, random), {}};
    const bool on_lattice = random.below(2) == 0;
    for (size_t a = 0; a < 3; ++a) {
        ray.direction[a] = random.sign() * (kDirectionOne - random.between(0, 3));
        if (on_lattice)
            ray.origin[a] = std::clamp<int64_t>(
                random.between(0, grid.size[int(a)]) * grid.unit() + random.between(-1, 1), 0,
                int64_t(grid.size[int(a)]) * grid.unit());
    }
    if (random.below(3) == 0) ray.direction[random.below(3)] = random.between(-2, 2);
    return ray;
}

/// A ray from a side, an edge or a corner of the grid, often along it.
FixedRay from_a_side(const FixedGrid& grid, StressRandom& random) {
    FixedRay ray{any_origin(grid, random), any_direction(random)};
    const uint64_t axes = 1 + random.below(7);
    for (size_t a = 0; a < 3; ++a) {
        if (!(axes >> a & 1)) continue;
        ray.origin[a] = random.below(2) ? int64_t(grid.size[int(a)]) * grid.unit() : 0;
        if (random.below(3) == 0) ray.direction[a] = random.between(-1, 1);
    }
    if (largest(ray.direction) < kDirectionOne / 2)
        ray.direction[random.below(3)] =
            random.sign() * random.between(kDirectionOne / 2, kDirectionOne);
    return ray;
}

}  // namespace

FixedRay ray_of_class(RayClass kind, const FixedGrid& grid, uint64_t seed, uint64_t number) {
    StressRandom random(seed, uint64_t(kind), number);
    switch (kind) {
        case RayClass::random:
            return {any_origin(grid, random), any_direction(random)};
        case RayClass::ties:
            return between_lattice_points(grid, random);
        case RayClass::grazing:
            return in_a_plane(grid, random);
        case RayClass::corners:
            return through_a_corner(grid, random);
        case RayClass::parallel:
            return along_an_axis(grid, random);
        case RayClass::diagonal:
            return along_a_diagonal(grid, random);
        case RayClass::faces:
            return from_a_side(grid, random);
    }
    return {};
}

}  // namespace voxelume
