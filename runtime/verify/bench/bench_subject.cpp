// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_subject.hpp"

#include <array>
#include <filesystem>
#include <numbers>

#include "runtime/verify/bench/bench_gyroid.hpp"
#include "runtime/verify/bench/bench_mesh.hpp"
#include "runtime/verify/bench/bench_whitted.hpp"

namespace voxelume {
namespace {

bool always() {
    return true;
}

bool has_bunny() {
    std::error_code error;
    return std::filesystem::is_regular_file(kBunnyFile, error);
}

std::optional<Extent> extent_of(const Solid& solid) {
    const double r = solid.radius, t = solid.tube;
    const glm::dvec3 s = solid.size;
    switch (solid.kind) {
        case SolidKind::sphere:
            return Extent{4 * std::numbers::pi / 3 * r * r * r, 4 * std::numbers::pi * r * r};
        case SolidKind::torus:
            return Extent{2 * std::numbers::pi * std::numbers::pi * r * t * t,
                          4 * std::numbers::pi * std::numbers::pi * r * t};
        case SolidKind::box:
            return Extent{s.x * s.y * s.z, 2 * (s.x * s.y + s.y * s.z + s.z * s.x)};
        default:
            return {};
    }
}

template <size_t Number>
BenchSubject solid_subject() {
    return subject_of(bench_solids()[Number]);
}

}  // namespace

BenchSubject subject_of(const BenchSolid& solid) {
    BenchSubject subject;
    subject.name = solid.name;
    subject.min_radius = solid.min_radius;
    subject.extent = extent_of(solid.solid);
    subject.scene = [solid](Surface surface, int resolution, glm::ivec2 size) {
        return bench_scene(solid, surface, resolution, size);
    };
    subject.first_hit = [solid](const glm::dvec3& origin, const glm::dvec3& direction) {
        return analytic_hit(solid.solid, solid.world_from_solid, origin, direction);
    };
    return subject;
}

std::span<const BenchEntry> bench_entries() {
    static const std::array<BenchEntry, 6> entries = {{
        {"sphere", "radius 0.47 m", 8, 1 << 16, false, always, solid_subject<0>},
        {"torus", "radius 0.3 m, tube 0.19 m, turned", 8, 1 << 16, false, always, solid_subject<1>},
        {"box", "0.67 x 0.41 x 0.53 m, turned", 8, 1 << 16, false, always, solid_subject<2>},
        {"gyroid", "a gyroid rounded by a ball of 0.45 m, as a fine mesh", 16, 1 << 16, false,
         always, gyroid_subject},
        {"bunny", "the bunny of Debian's glmark2-data, 0.9 m long", 16, 1 << 16, false, has_bunny,
         bunny_subject},
        {"whitted", "scenes/whitted.json, with light", 4, 128, true, always, whitted_subject},
    }};
    return entries;
}

}  // namespace voxelume
