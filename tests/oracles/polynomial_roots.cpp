#include "tests/oracles/polynomial_roots.hpp"

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

/// The sign change between two values of different sign. The steps end below the last bit of the
/// interval: towards a root at 0 a float could be halved thousands of times.
Real bisect(const std::vector<Real>& coefficients, Real low, Real high) {
    const bool falls = value_at(coefficients, low) > 0;
    for (int step = 0; step < 100; ++step) {
        const Real middle = low + (high - low) / 2;
        ((value_at(coefficients, middle) > 0) == falls ? low : high) = middle;
    }
    return low + (high - low) / 2;
}

}  // namespace

std::vector<Real> sign_changes(const std::vector<Real>& coefficients, Real low, Real high) {
    if (coefficients.size() < 2) return {};
    std::vector<Real> slope;
    for (size_t i = 1; i < coefficients.size(); ++i) slope.push_back(coefficients[i] * Real(i));
    std::vector<Real> turns = sign_changes(slope, low, high);
    turns.push_back(high);
    std::vector<Real> found;
    for (const Real turn : turns) {  // the polynomial rises or falls throughout [low, turn]
        if ((value_at(coefficients, low) > 0) != (value_at(coefficients, turn) > 0))
            found.push_back(bisect(coefficients, low, turn));
        low = turn;
    }
    return found;
}

}  // namespace voxelume::oracle
