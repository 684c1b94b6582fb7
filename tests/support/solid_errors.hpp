// SPDX-License-Identifier: Apache-2.0
// The distance of a rendered solid from the solid itself, under any affine map: depths, normals,
// silhouette.
#pragma once

#include <algorithm>
#include <cmath>
#include <optional>

#include "runtime/render/renderer.hpp"
#include "runtime/verify/analytic/analytic_crossings.hpp"
#include "tests/support/accuracy_fixture.hpp"

namespace voxelume {

/// Errors of an image that shows one solid.
struct SolidErrors {
    size_t both = 0;        ///< pixels that show the solid and should
    double depth_rms = 0;   ///< metres along the sight rays
    double depth_max = 0;   ///< metres along the sight rays
    double normal_rms = 0;  ///< degrees
    size_t silhouette = 0;  ///< pixels that show the solid and shouldn't, or the other way round
};

/// The point where a line first enters a solid in front of the line's origin.
inline std::optional<oracle::Crossing> first_entry(const oracle::PlacedSolid& solid,
                                                   const oracle::Line& line) {
    const oracle::Crossings crossings = solid.crossings(line);
    for (int i = 0; i < crossings.count; ++i)
        if (crossings.list[size_t(i)].enters && crossings.list[size_t(i)].t > 0)
            return crossings.list[size_t(i)];
    return std::nullopt;
}

/// Compares an image of a scene with its object `number`, whose model is a solid. Pixels of other
/// objects don't count.
inline SolidErrors measure_solid(const Scene& scene, const Image& image, size_t number = 0) {
    const Object& object = scene.objects[number];
    const oracle::PlacedSolid solid(*scene.models[size_t(object.model)].solid,
                                    object.world_from_object);
    const auto plane = [&](const char* name) -> const Plane<float>& {
        return image.planes.at(name);
    };
    SolidErrors errors;
    double depth = 0, normal = 0;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            const uint32_t shown = image.id_planes.at("objectId")[pixel];
            if (shown != 0 && shown != number + 1) continue;
            const oracle::Line line{scene.observer.position, pixel_direction(scene, column, row)};
            const auto entry = first_entry(solid, line);
            errors.silhouette += entry.has_value() != (shown != 0);
            if (!entry || shown == 0) continue;
            const glm::dvec3 p(plane("P.X")[pixel], plane("P.Y")[pixel], plane("P.Z")[pixel]);
            const glm::dvec3 n(plane("N.X")[pixel], plane("N.Y")[pixel], plane("N.Z")[pixel]);
            const double off = std::abs(glm::dot(p - line.origin, line.direction) - entry->t);
            const glm::dvec3 true_normal =
                solid.normal(line.origin + line.direction * entry->t, entry->face);
            const double angle =
                std::atan2(glm::length(glm::cross(n, true_normal)), glm::dot(n, true_normal));
            ++errors.both;
            depth += off * off;
            normal += angle * angle;
            errors.depth_max = std::max(errors.depth_max, off);
        }
    const auto count = double(std::max<size_t>(errors.both, 1));
    errors.depth_rms = std::sqrt(depth / count);
    errors.normal_rms = glm::degrees(std::sqrt(normal / count));
    return errors;
}

}  // namespace voxelume
