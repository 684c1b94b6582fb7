// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/exact_sum.hpp"

#include <cmath>

namespace voxelume {

ExactSum::ExactSum(double value) {
    if (value != 0) terms_.push_back(value);
}

ExactSum& ExactSum::operator+=(double value) {
    // Each step keeps sum + error exactly equal to carry + term (Knuth's two-sum).
    double carry = value;
    size_t kept = 0;
    for (const double term : terms_) {
        const double sum = carry + term, shared = sum - carry;
        const double error = (carry - (sum - shared)) + (term - shared);
        carry = sum;
        if (error != 0) terms_[kept++] = error;
    }
    terms_.resize(kept);
    if (carry != 0) terms_.push_back(carry);
    return *this;
}

ExactSum& ExactSum::operator+=(const ExactSum& other) {
    for (const double term : std::vector<double>(other.terms_)) *this += term;
    return *this;
}

ExactSum operator*(const ExactSum& a, double factor) {
    ExactSum product;
    for (const double term : a.terms_) {
        const double rounded = term * factor;
        product += std::fma(term, factor, -rounded);
        product += rounded;
    }
    return product;
}

ExactSum operator*(const ExactSum& a, const ExactSum& b) {
    ExactSum product;
    for (const double factor : b.terms_) product += a * factor;
    return product;
}

int ExactSum::sign() const {
    if (terms_.empty()) return 0;
    return terms_.back() > 0 ? 1 : -1;
}

}  // namespace voxelume
