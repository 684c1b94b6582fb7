// SPDX-License-Identifier: Apache-2.0
// Uses Clinger's fast path in double with a proof that the float is rounded correctly, and
// std::from_chars otherwise.
#include "runtime/base/decimal.hpp"

#include <bit>
#include <charconv>
#include <limits>
#include <system_error>

namespace voxelume {
namespace {

constexpr int kMaxExactPower = 22;  // 10^22 is the last power of ten that is a double
constexpr double kPowersOfTen[kMaxExactPower + 1] = {1e0,  1e1,  1e2,  1e3,  1e4,  1e5,  1e6,  1e7,
                                                     1e8,  1e9,  1e10, 1e11, 1e12, 1e13, 1e14, 1e15,
                                                     1e16, 1e17, 1e18, 1e19, 1e20, 1e21, 1e22};

bool is_digit(char c) {
    return c >= '0' && c <= '9';
}

/// The parts of a decimal number: mantissa * 10^exponent. It is exact up to 19 digits.
struct Parts {
    uint64_t mantissa = 0;
    int64_t exponent = 0;
    int64_t digits = 0;  ///< significant ones, without leading zeros
    bool negative = false;
    const char* first = nullptr;  ///< position behind a plus sign, where from_chars may begin
    const char* end = nullptr;    ///< null if there is no number
};

/// Adds the digits at `p` to the mantissa, without leading zeros, and returns their end.
const char* scan_digits(const char* p, Parts& parts) {
    for (; is_digit(*p); ++p) {
        parts.mantissa = parts.mantissa * 10 + static_cast<uint64_t>(*p - '0');  // wraps after 19
        parts.digits += parts.digits > 0 || *p != '0';
    }
    return p;
}

Parts take_apart(const char* text) {
    Parts parts;
    const char* p = text;
    parts.negative = *p == '-';
    parts.first = *p == '+' ? text + 1 : text;
    if (parts.negative || *p == '+') {
        ++p;
    }
    const char* const whole = p;
    p = scan_digits(p, parts);
    bool any_digit = p != whole;
    if (*p == '.') {
        const char* const fraction = ++p;
        p = scan_digits(p, parts);
        parts.exponent = fraction - p;
        any_digit |= p != fraction;
    }
    if (!any_digit) {
        return parts;
    }
    if (*p == 'e' || *p == 'E') {
        const Integer exponent = scan_integer(p + 1);
        if (exponent.end != p + 1) {
            parts.exponent += exponent.value;
            p = exponent.end;
        }
    }
    parts.end = p;
    return parts;
}

/// True if rounding `value` to float gives the float nearest to the decimal. The mantissa and the
/// power are each within half an ulp, so is their combination, and the result lies within 2 ulp of
/// the decimal. Rounding it to float is then right unless the midpoint of two floats is that near.
///
///     double's mantissa  [ 23 bits kept | 29 bits dropped ]     midpoint: dropped = 1 0...0
bool rounds_safely(double value) {
    constexpr uint64_t kDropped = (uint64_t{1} << 29) - 1;
    constexpr uint64_t kMidpoint = uint64_t{1} << 28;
    const uint64_t dropped = std::bit_cast<uint64_t>(value) & kDropped;
    const bool near_midpoint = dropped - (kMidpoint - 4) <= 8;
    return !near_midpoint && value >= std::numeric_limits<float>::min() &&
           value <= std::numeric_limits<float>::max();
}

}  // namespace

Decimal scan_decimal(const char* text) noexcept {
    const Parts parts = take_apart(text);
    if (parts.end == nullptr) {
        return {0.0f, text, DecimalStatus::not_a_number};
    }
    if (parts.digits == 0) {
        return {parts.negative ? -0.0f : 0.0f, parts.end, DecimalStatus::ok};
    }
    if (parts.digits <= 19 && parts.exponent >= -kMaxExactPower &&
        parts.exponent <= kMaxExactPower) {
        const auto mantissa = static_cast<double>(parts.mantissa);
        const double value = parts.exponent < 0 ? mantissa / kPowersOfTen[-parts.exponent]
                                                : mantissa * kPowersOfTen[parts.exponent];
        if (rounds_safely(value)) {
            const auto rounded = static_cast<float>(value);
            return {parts.negative ? -rounded : rounded, parts.end, DecimalStatus::ok};
        }
    }
    float value = 0.0f;
    const std::from_chars_result result = std::from_chars(parts.first, parts.end, value);
    if (result.ec == std::errc{} && value <= std::numeric_limits<float>::max() &&
        value >= std::numeric_limits<float>::lowest()) {
        return {value, parts.end, DecimalStatus::ok};
    }
    // from_chars reports too large and too small numbers alike. The decimal's magnitude tells them
    // apart.
    const bool tiny = parts.exponent + parts.digits <= 0;
    return {parts.negative ? -0.0f : 0.0f, parts.end,
            tiny ? DecimalStatus::ok : DecimalStatus::beyond_float};
}

}  // namespace voxelume
