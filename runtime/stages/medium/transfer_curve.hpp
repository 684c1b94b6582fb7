// SPDX-License-Identifier: Apache-2.0
// Values of a scan -> emission and absorption, averaged exactly over voxels.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "runtime/scene/parts/world.hpp"

namespace voxelume {

/// A transfer function: absorption, and absorption times colour, are linear between its points and
/// constant beyond the first and the last.
class TransferCurve {
  public:
    /// The points' values must increase from point to point, however little.
    explicit TransferCurve(std::span<const TransferPoint> points);

    /// Absorption times colour, and in `w` the absorption, at a value: exactly 0 between points
    /// where both are 0, and exactly the first or last point's beyond the ends.
    glm::dvec4 at(double value) const;

    /// The mean of the curve over a box with these values at its corners, x fastest. Values between
    /// are interpolated linearly, and the mean is then exact: it is a sum of box splines of the
    /// points. A corner outside of the scan is kOutsideScan and counts as empty.
    glm::dvec4 mean(const std::array<float, 8>& corners) const;

    /// True if the curve is 0 at all values from `min` to `max`.
    bool is_zero_in(double min, double max) const;

  private:
    size_t points_up_to(double value) const;
    /// True if a point lies between two values.
    bool bends_in(double min, double max) const;

    std::vector<double> values_;
    std::vector<glm::dvec4> lights_;  ///< at the values
};

}  // namespace voxelume
