// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/transfer_curve.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

#include "runtime/grid/density_field.hpp"

namespace voxelume {
namespace {

/// The emission (absorption times colour) and the absorption at a transfer point.
glm::dvec4 light_of(const TransferPoint& point) {
    return {glm::dvec3(point.color) * point.absorption, point.absorption};
}

/// u^power, the same on every machine, as pow() isn't.
double raised(double u, size_t power) {
    double result = 1;
    for (size_t i = 0; i < power; ++i) result *= u;
    return result;
}

/// The mean of max(u, 0)^power, with a power of 0 or 1, over a box in whose middle u is `middle`
/// and along whose edges it grows by `rises`: a sum of truncated powers over the corners (de Boor
/// 1976).
double mean_ramp(double middle, std::span<const double> rises, size_t power) {
    double reach = 0, divisor = 1;
    for (size_t i = 0; i < rises.size(); ++i) {
        reach += rises[i] / 2;
        divisor *= rises[i] * double(i + 1 + power);
    }
    if (middle >= reach) return power == 0 ? 1 : middle;
    if (middle <= -reach) return 0;
    double sum = 0;
    for (size_t corner = 0; corner < size_t{1} << rises.size(); ++corner) {
        double u = middle, sign = 1;
        for (size_t i = 0; i < rises.size(); ++i) {
            const bool is_high = (corner >> i & 1) != 0;
            u += is_high ? rises[i] / 2 : -rises[i] / 2;
            if (!is_high) sign = -sign;
        }
        if (u > 0) sum += sign * raised(u, rises.size() + power);
    }
    return sum / divisor;
}

/// The mean, over the box of mean_ramp(), of a function that rises from 0 at one value to 1 at
/// another. It needs no slope, which is unbounded if the two values are close.
double mean_step(double from, double to, double middle, std::span<const double> rises,
                 double reach) {
    // The difference of means would be lost in rounding here.
    if (to - from < 1e-5 * reach) return mean_ramp(middle - (from + (to - from) / 2), rises, 0);
    return (mean_ramp(middle - from, rises, 1) - mean_ramp(middle - to, rises, 1)) / (to - from);
}

/// The rises of the values along the edges of a box, without negligible ones: their effect on the
/// mean would be lost in rounding.
size_t find_rises(const std::array<float, 8>& corners, std::array<double, 3>& rises) {
    std::array<double, 3> all{};
    for (size_t corner = 0; corner < 8; ++corner)
        for (size_t axis = 0; axis < 3; ++axis)
            all[axis] += ((corner >> axis & 1) != 0 ? 0.25 : -0.25) * double(corners[corner]);
    double max = 0;
    for (double& rise : all) max = std::max(max, rise = std::abs(rise));
    size_t count = 0;
    for (const double rise : all)
        if (rise > 1e-4 * max) rises[count++] = rise;
    return count;
}

}  // namespace

TransferCurve::TransferCurve(std::span<const TransferPoint> points) {
    for (const TransferPoint& point : points) {
        values_.push_back(point.value);
        lights_.push_back(light_of(point));
    }
}

size_t TransferCurve::points_up_to(double value) const {
    return size_t(std::ranges::upper_bound(values_, value) - values_.begin());
}

bool TransferCurve::bends_in(double min, double max) const {
    const size_t next = points_up_to(min);
    return next < values_.size() && values_[next] < max;
}

glm::dvec4 TransferCurve::at(double value) const {
    const size_t next = points_up_to(value);
    if (next == 0) return lights_.front();
    if (next == values_.size()) return lights_.back();
    const double share = (value - values_[next - 1]) / (values_[next] - values_[next - 1]);
    return lights_[next - 1] * (1 - share) + lights_[next] * share;
}

glm::dvec4 TransferCurve::mean(const std::array<float, 8>& corners) const {
    double sum = 0;
    size_t inside = 0;
    for (const float corner : corners) {
        if (corner == kOutsideScan) continue;
        sum += double(corner);
        ++inside;
    }
    if (inside == 0) return glm::dvec4(0);
    const double middle = sum / double(inside);
    if (inside < corners.size()) return at(middle) * (double(inside) / 8);
    const auto [min, max] = std::ranges::minmax(corners);
    if (!bends_in(min, max)) return at(middle);
    std::array<double, 3> rises{};
    const size_t count = find_rises(corners, rises);
    const auto kept = std::span<const double>(rises).first(count);
    const double reach = std::accumulate(kept.begin(), kept.end(), 0.0) / 2;
    if (!bends_in(middle - reach, middle + reach)) return at(middle);
    const size_t next = points_up_to(middle - reach);
    glm::dvec4 mean = lights_[next == 0 ? 0 : next - 1];
    for (size_t i = std::max<size_t>(next, 1);
         i < values_.size() && values_[i - 1] < middle + reach; ++i)
        mean += (lights_[i] - lights_[i - 1]) *
                std::clamp(mean_step(values_[i - 1], values_[i], middle, kept, reach), 0.0, 1.0);
    return glm::max(mean, glm::dvec4(0));
}

bool TransferCurve::is_zero_in(double min, double max) const {
    if (at(min).w != 0 || at(max).w != 0) return false;
    for (size_t i = 0; i < values_.size(); ++i)
        if (values_[i] > min && values_[i] < max && lights_[i].w != 0) return false;
    return true;
}

}  // namespace voxelume
