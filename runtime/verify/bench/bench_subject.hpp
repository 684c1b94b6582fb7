// SPDX-License-Identifier: Apache-2.0
// The subjects that `voxelume bench` shows, with the truth that images are compared with.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>

#include "runtime/verify/analytic/analytic_ray.hpp"
#include "runtime/verify/bench/bench_extent.hpp"
#include "runtime/verify/bench/bench_scene.hpp"

namespace voxelume {

/// The first point where a ray from outside meets the subject. `direction` is a unit vector.
/// Several threads may call it.
using FirstHit = std::function<std::optional<AnalyticHit>(const glm::dvec3& origin,
                                                          const glm::dvec3& direction)>;

/// The light along such a ray. Several threads may call it.
using Radiance = std::function<glm::dvec3(const glm::dvec3& origin, const glm::dvec3& direction)>;

/// A subject that can be rendered with any surface, in voxels of any size.
struct BenchSubject {
    std::string name;
    double min_radius = 0;  ///< minimum radius of curvature, metres; 0 for edges, or if unknown
    std::function<Scene(Surface, int resolution, glm::ivec2 size)> scene;  ///< voxels per metre
    FirstHit first_hit;
    Radiance radiance;             ///< empty for a scene without lights
    std::optional<Extent> extent;  ///< extent of the only object; empty if unknown
};

/// A subject by its name. It is made only when needed, because that may read files.
struct BenchEntry {
    const char* name;
    const char* help;
    int coarsest, finest;  ///< the range of useful resolutions, voxels per metre
    bool has_light;
    bool (*is_there)();  ///< returns true if the files that it needs exist
    BenchSubject (*open)();
};

/// All subjects, in the order of measurement.
std::span<const BenchEntry> bench_entries();

BenchSubject subject_of(const BenchSolid& solid);

}  // namespace voxelume
