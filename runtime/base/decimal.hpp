// Decimal text -> float and integer, fast and correctly rounded: the inner loop of every text mesh.
#pragma once

#include <cstdint>

namespace voxelume {

/// How scanning a number ended.
enum class DecimalStatus { ok, not_a_number, beyond_float };

/// A scanned number and the first character behind it. `end` is the start when there is no number.
struct Decimal {
    float value;
    const char* end;
    DecimalStatus status;
};

/// Scans `[+-]digits[.digits][(e|E)[+-]digits]` at `text`, which a NUL must end somewhere.
///
/// The value is the float nearest to the decimal, ties to even; what is too small becomes zero of
/// its sign, what rounds beyond the largest float is `beyond_float`. "nan" and "inf" are no
/// numbers.
Decimal scan_decimal(const char* text) noexcept;

/// A scanned integer; `end` is the start when there is none. Beyond +-10^18 it stays at that bound.
struct Integer {
    int64_t value;
    const char* end;
};

/// Scans `[+-]digits` at `text`, which a NUL must end somewhere.
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
