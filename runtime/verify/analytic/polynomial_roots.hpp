// SPDX-License-Identifier: Apache-2.0
// The real roots of polynomials. Each is searched between two roots of the derivative.
#pragma once

#include <vector>

namespace voxelume::oracle {

/// The t in (low, high), ascending, where c[0] + c[1] t + c[2] t^2 + ... changes its sign. Even
/// roots, where it only touches zero, aren't among them.
std::vector<long double> sign_changes(const std::vector<long double>& coefficients, long double low,
                                      long double high);

}  // namespace voxelume::oracle
