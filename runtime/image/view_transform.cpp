// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/view_transform.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "runtime/image/srgb.hpp"

namespace voxelume {
namespace {

/// The darkest and the brightest light that AgX tells apart, in stops from 1: 10 below middle grey
/// of 0.18, and 6.5 above it.
const double kMiddleStop = std::log2(0.18);
constexpr double kStopsBelow = 10, kStopsAbove = 6.5;

/// The matrix, by columns, from Rec. 709 to primaries that lie 1.25 times as far from white. Greys
/// stay.
const glm::dmat3 kInset(0.84239893, 0.04239893, 0.04239893, 0.07843017, 0.87843017, 0.07843017,
                        0.07917091, 0.07917091, 0.87917091);

/// A curve through 0 with slope 1 that approaches 1.
double shoulder(double x, double power) {
    return x / std::pow(1 + std::pow(x, power), 1 / power);
}

/// The size of a shoulder whose slope at 0 is `slope`, which gets to `height` at `length`.
double shoulder_size(double length, double height, double slope, double power) {
    const double straight = std::pow(slope * length, -power);
    return std::pow(straight * (std::pow(slope * length / height, power) - 1), -1 / power);
}

/// Values of AgX's curve for lights whose floats begin with the same 16 bits, from kFirst on.
/// Between two such lights the value is interpolated linearly, which is off by less than 1e-5.
/// Rounding to 2^-22 hides the differences of mathematical libraries.
class CurveTable {
  public:
    CurveTable() {
        for (uint32_t i = 0; i < kEntries; ++i)
            values_[i] = value_at(double(std::bit_cast<float>((kFirst + i) << kShift)));
    }

    float operator()(float light) const {
        const uint32_t bits = std::bit_cast<uint32_t>(std::max(light, 0.0f));
        const uint32_t entry = bits >> kShift;
        if (entry < kFirst) return values_.front();
        if (entry - kFirst + 1 >= kEntries) return values_.back();
        const float share = float(bits & ((1u << kShift) - 1)) / float(1u << kShift);
        const float low = values_[entry - kFirst], high = values_[entry - kFirst + 1];
        return low + (high - low) * share;
    }

  private:
    static float value_at(double light) {
        constexpr double kSteps = 1 << 22;
        const double stop = (std::log2(light) - kMiddleStop + kStopsBelow);
        return float(std::round(agx_curve(stop / (kStopsBelow + kStopsAbove)) * kSteps) / kSteps);
    }

    static constexpr uint32_t kShift = 16;
    static constexpr uint32_t kFirst = 0x3900;  ///< bits of 2^-13, below the darkest light
    static constexpr uint32_t kEntries = 0x4200 - kFirst;  ///< up to 2^5
    std::array<float, kEntries> values_{};
};

/// A colour whose channels are close to each other if it is bright, as codes from 0 to 1.
glm::vec3 agx(const glm::vec3& linear) {
    static const CurveTable curve;
    static const glm::mat3 inset(kInset), outset(glm::inverse(kInset));
    const glm::vec3 wide = inset * linear;
    return outset * glm::vec3(curve(wide.r), curve(wide.g), curve(wide.b));
}

/// Floats with equal bits from here on have an entry of ColorCodes::starts_: 256 to a power of two.
constexpr uint32_t kStartShift = 15;

float filmic(float x) {
    return (x * (2.51f * x + 0.03f)) / (x * (2.43f * x + 0.59f) + 0.14f);
}

}  // namespace

double agx_curve(double position) {
    constexpr double kSlope = 2.4, kPower = 1.5;
    const double at = kStopsBelow / (kStopsBelow + kStopsAbove);
    const double grey = std::pow(0.18, 1 / 2.4);
    const double x = std::clamp(position, 0.0, 1.0) - at;
    if (x == 0) return grey;
    const bool is_above = x > 0;
    const double size =
        shoulder_size(is_above ? 1 - at : at, is_above ? 1 - grey : grey, kSlope, kPower);
    const double rise = size * shoulder(kSlope * std::abs(x) / size, kPower);
    return is_above ? grey + rise : grey - rise;
}

ColorCodes::ColorCodes(ViewTransform transform, int bits)
    : transform_(transform),
      maximum_(uint16_t((1u << bits) - 1)),
      thresholds_(srgb_thresholds(maximum_)),
      first_prefix_(std::bit_cast<uint32_t>(thresholds_.front()) >> kStartShift) {
    const uint32_t last = std::bit_cast<uint32_t>(thresholds_.back()) >> kStartShift;
    for (uint32_t prefix = first_prefix_; prefix <= last + 1; ++prefix) {
        const auto least = std::bit_cast<float>(prefix << kStartShift);
        const auto above = std::ranges::upper_bound(thresholds_, least);
        starts_.push_back(uint32_t(above - thresholds_.begin()));
    }
}

uint16_t ColorCodes::code(float value) const {
    return uint16_t(std::lround(std::clamp(value, 0.0f, 1.0f) * float(maximum_)));
}

// A search in the thresholds rounds exactly, and gives equal codes on every machine; pow at each
// pixel does neither.
uint16_t ColorCodes::srgb(float linear) const {
    if (linear < thresholds_.front()) return 0;
    if (linear >= thresholds_.back()) return maximum_;
    const uint32_t entry = (std::bit_cast<uint32_t>(linear) >> kStartShift) - first_prefix_;
    const auto begin = thresholds_.begin();
    return uint16_t(std::upper_bound(begin + starts_[entry], begin + starts_[entry + 1], linear) -
                    begin);
}

std::array<uint16_t, 3> ColorCodes::operator()(const glm::vec3& linear) const {
    constexpr float kBrightest = 1e6f;  // largest value; its square is finite
    const auto finite = [&](float v) { return std::isnan(v) ? 0.0f : std::min(v, kBrightest); };
    const glm::vec3 c(finite(linear.r), finite(linear.g), finite(linear.b));
    switch (transform_) {
        case ViewTransform::srgb:
            break;
        case ViewTransform::none:
            return {code(c.r), code(c.g), code(c.b)};
        case ViewTransform::filmic: {
            const glm::vec3 lit = glm::max(c, glm::vec3(0));
            return {srgb(filmic(lit.r)), srgb(filmic(lit.g)), srgb(filmic(lit.b))};
        }
        case ViewTransform::agx: {
            const glm::vec3 shown = agx(c);
            return {code(shown.r), code(shown.g), code(shown.b)};
        }
    }
    return {srgb(c.r), srgb(c.g), srgb(c.b)};
}

}  // namespace voxelume
