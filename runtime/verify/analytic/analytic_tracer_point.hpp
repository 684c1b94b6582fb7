// SPDX-License-Identifier: Apache-2.0
// What the parts of the analytic tracer share: a surface point, and the record of decisions.
#pragma once

#include "runtime/verify/analytic/analytic_tracer.hpp"

namespace voxelume::oracle {

/// The point where a ray meets a surface.
struct AnalyticTracer::Point {
    glm::dvec3 position{0};
    glm::dvec3 normal{0};  ///< unit vector, against the ray
    glm::dvec3 color{0};
    const Material* material = nullptr;
};

/// A record of every decision on the way, in order, and of the first surface shown.
struct AnalyticTracer::Events {
    uint64_t hash = 14695981039346656037u;  // FNV-1a
    int object = -1;
    double t = std::numeric_limits<double>::infinity();

    void add(uint64_t event) { hash = (hash ^ event) * 1099511628211u; }
};

}  // namespace voxelume::oracle
