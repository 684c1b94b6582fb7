// SPDX-License-Identifier: Apache-2.0
// Spheres and turned boxes in double precision, and their points that an observer sees.
#pragma once

#include <glm/mat3x3.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <vector>

namespace voxelume::oracle {

/// A sphere (`radius` > 0), or a box with the given half edges along the columns of `axes`.
struct SimpleSolid {
    glm::dvec3 center{0};
    double radius = 0;
    glm::dvec3 half{0};
    glm::dmat3 axes{1};

    /// Metres to the surface, negative inside.
    double distance(const glm::dvec3& p) const;

    /// The interval in which the ray is inside, with t in lengths of `direction`.
    struct Span {
        double enter, leave;
    };
    std::optional<Span> span(const glm::dvec3& origin, const glm::dvec3& direction) const;

    /// Points of the surface, no farther apart than `spacing`.
    std::vector<glm::dvec3> surface_points(double spacing) const;
};

struct SimpleScene {
    std::vector<SimpleSolid> solids;

    double distance(const glm::dvec3& p) const;  ///< to the nearest surface, >= 0

    /// The smallest t >= first at which the ray meets a surface.
    std::optional<double> first_hit(const glm::dvec3& origin, const glm::dvec3& direction,
                                    double first) const;

    /// True if nothing hides `p` from `from`, except within `clear` metres in front of `p`.
    bool is_seen(const glm::dvec3& from, const glm::dvec3& p, double clear) const;
};

}  // namespace voxelume::oracle
