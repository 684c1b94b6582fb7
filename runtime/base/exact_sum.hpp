// SPDX-License-Identifier: Apache-2.0
// Sums and products of doubles without rounding: the sign of a polynomial, decided exactly.
#pragma once

#include <vector>

namespace voxelume {

/// An exact number: the unevaluated sum of doubles that do not overlap, smallest first.
///
/// It is exact as long as no partial product falls below 2^-1022 or above 2^1023. After Shewchuk
/// 1997, "Adaptive precision floating-point arithmetic", grow-expansion and scale-expansion.
class ExactSum {
  public:
    ExactSum() = default;
    ExactSum(double value);  // NOLINT(google-explicit-constructor): a double is an exact number

    ExactSum& operator+=(double value);
    ExactSum& operator+=(const ExactSum& other);
    friend ExactSum operator+(ExactSum a, const ExactSum& b) { return a += b; }
    friend ExactSum operator-(const ExactSum& a) { return a * -1.0; }
    friend ExactSum operator-(ExactSum a, const ExactSum& b) { return a += -b; }
    friend ExactSum operator*(const ExactSum& a, double factor);
    friend ExactSum operator*(const ExactSum& a, const ExactSum& b);

    /// The number's sign: -1, 0 or 1.
    int sign() const;

  private:
    std::vector<double> terms_;  // without zeros; empty for 0
};

inline ExactSum square(const ExactSum& a) {
    return a * a;
}

}  // namespace voxelume
