// SPDX-License-Identifier: Apache-2.0
// Values of a scan -> what light loses and gains there, averaged exactly over voxels.
#pragma once

#include <array>
#include <glm/vec4.hpp>
#include <span>
#include <vector>

#include "runtime/scene/world.hpp"

namespace voxelume {

/// A transfer function: absorption, and absorption times colour, are linear between its points and
/// constant beyond the first and the last.
class TransferCurve {
  public:
    /// The points' values increase.
    explicit TransferCurve(std::span<const TransferPoint> points);

    /// Absorption times colour, and in `w` the absorption, at a value.
    glm::dvec4 at(double value) const;

    /// Their mean over a box at whose corners are these values, x fastest. The values between are
    /// taken for linear, and then the mean is exact: it is a sum of box splines of the points.
    /// A corner outside of the scan is kOutsideScan, and nothing is there.
    glm::dvec4 mean(const std::array<float, 8>& corners) const;

    /// Whether there is nothing at all values from `min` to `max`.
    bool is_zero_in(double min, double max) const;

  private:
    glm::dvec4 combined(std::span<const double> ramps) const;

    std::vector<double> values_;
    std::vector<glm::dvec4> bends_;  ///< changes of the slope at the values
    glm::dvec4 before_{0};           ///< left of the first point
    std::vector<double> absorptions_;
};

}  // namespace voxelume
