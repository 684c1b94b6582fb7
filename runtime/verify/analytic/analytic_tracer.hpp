// SPDX-License-Identifier: Apache-2.0
// Whitted's ray tracing of analytic solids in double precision: the light that a ray brings.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <limits>
#include <vector>

#include "runtime/scene/scene.hpp"
#include "runtime/verify/analytic/analytic_crossings.hpp"

namespace voxelume::oracle {

/// The result of tracing a ray.
struct Seen {
    glm::dvec3 radiance{0};
    uint64_t signature = 0;  ///< hash of every decision on the way: which surfaces, lit or not,
                             ///< which square of a checker, total reflection, paths ended
    int object = -1;         ///< index of the first object shown, -1 for none
    double t = std::numeric_limits<double>::infinity();  ///< metres to that object
};

/// Traces one scene. Its objects have to be shapes, not combinations of them, as `exact` surfaces.
/// They don't form unions with each other, and the world's lattice
/// cuts them open.
///
/// It follows Whitted 1980 with the meaning that scenes/manual/materials.md gives to materials.
/// Where surfaces of two objects coincide, the order in which a ray crosses them is undefined.
class AnalyticTracer {
  public:
    /// Keeps a reference to the scene. Throws std::invalid_argument for unsupported solids and for
    /// a medium with a density.
    explicit AnalyticTracer(const Scene& scene);

    /// Traces the ray from `origin` along the unit vector `direction`, between `t_first` and
    /// `t_last` metres. Only the ray itself ends at `t_last`, not the rays that it causes. The
    /// origin may lie outside of the world.
    Seen trace(const glm::dvec3& origin, const glm::dvec3& direction, double t_first = 0,
               double t_last = std::numeric_limits<double>::infinity()) const;

  private:
    /// A ray on its way, with the objects that it is inside of.
    struct Path {
        Line line;
        double t = 0;                 ///< distance that the ray has passed, metres
        double t_last = 0;            ///< distance to the far plane or the end of the world
        std::vector<uint8_t> inside;  ///< per object
        glm::dvec3 weight{1};         ///< share of the ray in the image
        int depth = 0;                ///< remaining reflections and refractions
    };
    struct Surface {
        int object = -1;  ///< -1: none
        Crossing crossing;
    };
    struct Point;
    struct Events;

    Surface next_surface(const Path& path) const;
    int effective(const std::vector<uint8_t>& inside) const;
    bool transmits(int object) const;
    bool is_hidden(const Path& path, const Surface& surface) const;
    void find_inside(Path& path) const;
    void pass(const Path& path, double t, glm::dvec3& transmittance, glm::dvec3& emitted) const;
    glm::dvec3 color(const Material& material, const glm::dvec3& position, Events& events) const;
    Point point_at(const Path& path, const Surface& surface, Events& events) const;

    glm::dvec3 radiance(Path path, Events& events) const;
    glm::dvec3 surface_radiance(const Path& path, const Surface& surface, Events& events) const;
    glm::dvec3 scattered(const Path& path, const Surface& surface, const Point& point,
                         Events& events) const;
    glm::dvec3 share_of(const Light& light, const Path& path, const Point& point,
                        Events& events) const;
    glm::dvec3 shadow(const Path& path, const Point& point, const glm::dvec3& to_light,
                      double distance, Events& events) const;

    const Scene& scene_;
    glm::dvec3 world_min_, world_max_;  ///< bounds of the lattice, metres
    std::vector<PlacedSolid> solids_;   ///< per object
};

/// The reflectance for unpolarised light at the boundary between two indices of refraction, at the
/// given cosine (0..1) to the normal. It is 1 on total internal reflection.
double reflectance(double cosine, double ior_before, double ior_after);

}  // namespace voxelume::oracle
