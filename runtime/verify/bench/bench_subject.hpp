// What `voxelume bench` shows, with the truth that images are held to.
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

/// The first point in which a ray from outside meets what is shown; `direction` is a unit vector.
/// May be called by several threads.
using FirstHit = std::function<std::optional<AnalyticHit>(const glm::dvec3& origin,
                                                          const glm::dvec3& direction)>;

/// The light that such a ray brings. May be called by several threads.
using Radiance = std::function<glm::dvec3(const glm::dvec3& origin, const glm::dvec3& direction)>;

/// Something that can be rendered with any surface in voxels of any size.
struct BenchSubject {
    std::string name;
    double min_radius = 0;  ///< of curvature, metres; 0 for edges, and where it isn't known
    std::function<Scene(Surface, int resolution, glm::ivec2 size)> scene;  ///< voxels a metre
    FirstHit first_hit;
    Radiance radiance;             ///< empty for a scene without lights
    std::optional<Extent> extent;  ///< of the only object, where it is known
};

/// A subject by name, made when it is needed: that may read files.
struct BenchEntry {
    const char* name;
    const char* help;
    int coarsest, finest;  ///< voxels a metre between which it is worth showing
    bool has_light;
    bool (*is_there)();  ///< whether the files that it needs are
    BenchSubject (*open)();
};

/// All, in the order in which they are measured.
std::span<const BenchEntry> bench_entries();

BenchSubject subject_of(const BenchSolid& solid);

}  // namespace voxelume
