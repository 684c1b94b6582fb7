// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/transfer_curve.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/grid/density_field.hpp"

namespace voxelume {
namespace {

/// What light loses at a point, and what it gains.
glm::dvec4 light_of(const TransferPoint& point) {
    return {glm::dvec3(point.color) * point.absorption, point.absorption};
}

/// The mean of max(u, 0) over a box in whose middle u is `middle`, and along whose edges it grows
/// by `rises`: a sum over the corners of truncated powers (de Boor 1976).
double mean_ramp(double middle, std::span<const double> rises) {
    double reach = 0, divisor = 1;
    for (size_t i = 0; i < rises.size(); ++i) {
        reach += rises[i] / 2;
        divisor *= rises[i] * double(i + 2);
    }
    if (middle >= reach) return middle;
    if (middle <= -reach) return 0;
    double sum = 0;
    for (size_t corner = 0; corner < size_t{1} << rises.size(); ++corner) {
        double u = middle, sign = 1;
        for (size_t i = 0; i < rises.size(); ++i) {
            const bool is_high = (corner >> i & 1) != 0;
            u += is_high ? rises[i] / 2 : -rises[i] / 2;
            if (!is_high) sign = -sign;
        }
        if (u > 0) sum += sign * std::pow(u, double(rises.size() + 1));
    }
    return sum / divisor;
}

/// By how much the values rise along the edges of a box, without those that matter little beside
/// the largest: their share of the mean would be lost in rounding.
size_t find_rises(const std::array<float, 8>& corners, std::array<double, 3>& rises) {
    std::array<double, 3> all{};
    for (size_t corner = 0; corner < 8; ++corner)
        for (size_t axis = 0; axis < 3; ++axis)
            all[axis] += ((corner >> axis & 1) != 0 ? 0.25 : -0.25) * double(corners[corner]);
    double most = 0;
    for (double& rise : all) most = std::max(most, rise = std::abs(rise));
    size_t count = 0;
    for (const double rise : all)
        if (rise > 1e-4 * most) rises[count++] = rise;
    return count;
}

}  // namespace

TransferCurve::TransferCurve(std::span<const TransferPoint> points) {
    glm::dvec4 slope(0);
    for (size_t i = 0; i < points.size(); ++i) {
        const TransferPoint& point = points[i];
        glm::dvec4 next(0);
        if (i + 1 < points.size())
            next =
                (light_of(points[i + 1]) - light_of(point)) / (points[i + 1].value - point.value);
        values_.push_back(point.value);
        absorptions_.push_back(point.absorption);
        bends_.push_back(next - slope);
        slope = next;
    }
    before_ = light_of(points.front());
}

glm::dvec4 TransferCurve::combined(std::span<const double> ramps) const {
    glm::dvec4 sum = before_;
    for (size_t i = 0; i < ramps.size(); ++i) sum += bends_[i] * ramps[i];
    return glm::max(sum, glm::dvec4(0));
}

glm::dvec4 TransferCurve::at(double value) const {
    std::vector<double> ramps;
    for (const double point : values_) ramps.push_back(std::max(value - point, 0.0));
    return combined(ramps);
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
    std::array<double, 3> rises{};
    const size_t count = find_rises(corners, rises);
    std::vector<double> ramps;
    ramps.reserve(values_.size());
    for (const double point : values_)
        ramps.push_back(mean_ramp(middle - point, std::span(rises).first(count)));
    return combined(ramps);
}

bool TransferCurve::is_zero_in(double min, double max) const {
    if (at(min).w != 0 || at(max).w != 0) return false;
    for (size_t i = 0; i < values_.size(); ++i)
        if (values_[i] > min && values_[i] < max && absorptions_[i] != 0) return false;
    return true;
}

}  // namespace voxelume
