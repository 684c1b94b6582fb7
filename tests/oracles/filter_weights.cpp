// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/filter_weights.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace voxelume::oracle {
namespace {

double value(FilterShape shape, double x) {
    const double kPi = std::acos(-1.0);
    switch (shape) {
        case FilterShape::box:
            return 1;
        case FilterShape::tent:
            return 1 - 2 * std::abs(x);
        case FilterShape::gaussian: {  // the standard deviation is a sixth of the width
            const auto bell = [](double at) { return std::exp(-0.5 * (6 * at) * (6 * at)); };
            return bell(x) - bell(0.5);
        }
        case FilterShape::blackman_harris: {
            const double turn = 2 * kPi * (x + 0.5);
            return 0.35875 - 0.48829 * std::cos(turn) + 0.14128 * std::cos(2 * turn) -
                   0.01168 * std::cos(3 * turn);
        }
    }
    return 0;
}

/// Integrates by Simpson's rule. The tent's kink must not lie inside a part, so the integral is
/// split at 0.
double integral(FilterShape shape, double low, double high) {
    if (low < 0 && high > 0) return integral(shape, low, 0) + integral(shape, 0, high);
    constexpr int kParts = 200;
    const double step = (high - low) / kParts;
    double sum = 0;
    for (int i = 0; i < kParts; ++i)
        sum += value(shape, low + i * step) + 4 * value(shape, low + (i + 0.5) * step) +
               value(shape, low + (i + 1) * step);
    return sum * step / 6;
}

double whole(FilterShape shape) {
    static const std::array wholes = {integral(FilterShape::box, -0.5, 0.5),
                                      integral(FilterShape::tent, -0.5, 0.5),
                                      integral(FilterShape::gaussian, -0.5, 0.5),
                                      integral(FilterShape::blackman_harris, -0.5, 0.5)};
    return wholes[size_t(shape)];
}

}  // namespace

double filter_density(FilterShape shape, double x) {
    return std::abs(x) > 0.5 ? 0 : value(shape, x) / whole(shape);
}

double filter_weight(FilterShape shape, double low, double high) {
    low = std::clamp(low, -0.5, 0.5), high = std::clamp(high, -0.5, 0.5);
    return integral(shape, low, high) / whole(shape);
}

}  // namespace voxelume::oracle
