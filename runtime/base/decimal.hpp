// SPDX-License-Identifier: Apache-2.0
// Decimal text -> float and integer, fast and correctly rounded: the inner loop of every text mesh.
#pragma once

#include <cstdint>

namespace voxelume {

/// The result of scanning a number.
enum class DecimalStatus { ok, not_a_number, beyond_float };

/// A scanned number and the first character behind it. `end` is the start if there is no number.
struct Decimal {
    float value;
    const char* end;
    DecimalStatus status;
};

/// Scans `[+-]digits[.digits][(e|E)[+-]digits]` at `text`, which has to end in a NUL.
///
/// The value is the float nearest to the decimal, ties to even. A number that is too small becomes
/// zero of its sign, and one that rounds beyond the largest float is `beyond_float`. "nan" and
/// "inf" are no numbers.
Decimal scan_decimal(const char* text) noexcept;

/// A scanned integer. `end` is the start if there is none. Values beyond +-10^18 become that bound.
struct Integer {
    int64_t value;
    const char* end;
};

/// Scans `[+-]digits` at `text`, which has to end in a NUL.
inline Integer scan_integer(const char* text) noexcept {
    constexpr int64_t kBound = 1'000'000'000'000'000'000;
    const char* p = text;
    const bool negative = *p == '-';
    if (negative || *p == '+') {
        ++p;
    }
    const char* const digits = p;
    int64_t value = 0;
    for (; *p >= '0' && *p <= '9'; ++p) {
        value = value < kBound / 10 ? value * 10 + (*p - '0') : kBound;
    }
    return {negative ? -value : value, p == digits ? text : p};
}

}  // namespace voxelume
