// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/analytic/polynomial_roots.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>

namespace voxelume::oracle {
namespace {

using Real = long double;
using std::size_t;

Real value_at(const std::vector<Real>& coefficients, Real t) {
    Real sum = 0;
    for (size_t i = coefficients.size(); i-- > 0;) sum = sum * t + coefficients[i];
    return sum;
}

std::vector<Real> derivative(const std::vector<Real>& coefficients) {
    std::vector<Real> slope;
    for (size_t i = 1; i < coefficients.size(); ++i) slope.push_back(coefficients[i] * Real(i));
    return slope;
}

/// The sign change between two points with values of different sign. Newton's steps are taken where
/// they stay between the closest points known, halvings elsewhere.
Real sign_change(const std::vector<Real>& coefficients, const std::vector<Real>& slope, Real low,
                 Real high) {
    const bool falls = value_at(coefficients, low) > 0;
    const Real enough = 1e-19L * std::max(std::abs(low), std::abs(high));
    Real t = low + (high - low) / 2;
    for (int step = 0; step < 100; ++step) {
        const Real value = value_at(coefficients, t);
        ((value > 0) == falls ? low : high) = t;
        Real next = t - value / value_at(slope, t);
        if (!(next >= low && next <= high)) next = low + (high - low) / 2;
        if (std::abs(next - t) <= enough) return next;
        t = next;
    }
    return t;
}

}  // namespace

std::vector<Real> sign_changes(const std::vector<Real>& coefficients, Real low, Real high) {
    if (coefficients.size() < 2) return {};
    const std::vector<Real> slope = derivative(coefficients);
    std::vector<Real> turns = sign_changes(slope, low, high);
    turns.push_back(high);
    std::vector<Real> found;
    for (const Real turn : turns) {  // the polynomial rises or falls throughout [low, turn]
        if ((value_at(coefficients, low) > 0) != (value_at(coefficients, turn) > 0))
            found.push_back(sign_change(coefficients, slope, low, turn));
        low = turn;
    }
    return found;
}

}  // namespace voxelume::oracle
