// SPDX-License-Identifier: Apache-2.0
// Conclusions from rows of errors and times: the rate at which errors decrease, and the choices
// that are on the Pareto front.
#pragma once

#include <cstddef>
#include <span>
#include <vector>

namespace voxelume {

/// A straight line through the logarithms of points, by least squares.
struct SlopeFit {
    size_t points = 0;
    double slope = 0;       ///< 0 for fewer than two points
    double intercept = 0;   ///< natural logarithm of y at x = 1
    double half_width = 0;  ///< half width of the slope's 95 % interval (Student's t); infinite for
                            ///< < 3 points
};

/// Fits y = exp(intercept) * x^slope. Points whose x or y isn't positive are left out.
SlopeFit fit_slope(std::span<const double> x, std::span<const double> y);

/// The indices of the points that no other point beats, in the order of `x`. A point beats another
/// if it is at most as large in both coordinates and smaller in one.
std::vector<size_t> pareto_front(std::span<const double> x, std::span<const double> y);

}  // namespace voxelume
