// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/convergence.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace voxelume {
namespace {

/// The 97.5 % point of Student's t. From 30 degrees on it is that of 30, which is too wide by at
/// most 4 %.
double student_t(size_t degrees_of_freedom) {
    constexpr std::array kPoints = {12.7062, 4.3027, 3.1824, 2.7764, 2.5706, 2.4469, 2.3646, 2.3060,
                                    2.2622,  2.2281, 2.2010, 2.1788, 2.1604, 2.1448, 2.1314, 2.1199,
                                    2.1098,  2.1009, 2.0930, 2.0860, 2.0796, 2.0739, 2.0687, 2.0639,
                                    2.0595,  2.0555, 2.0518, 2.0484, 2.0452, 2.0423};
    return kPoints[std::min(degrees_of_freedom, kPoints.size()) - 1];
}

double mean_of(const std::vector<double>& values) {
    return std::accumulate(values.begin(), values.end(), 0.0) / double(values.size());
}

}  // namespace

SlopeFit fit_slope(std::span<const double> x, std::span<const double> y) {
    std::vector<double> u, v;
    for (size_t i = 0; i < x.size(); ++i) {
        if (!(x[i] > 0 && y[i] > 0)) continue;
        u.push_back(std::log(x[i]));
        v.push_back(std::log(y[i]));
    }
    SlopeFit fit;
    fit.points = u.size();
    fit.half_width = INFINITY;
    if (fit.points < 2) return fit;
    const double mean_u = mean_of(u), mean_v = mean_of(v);
    double uu = 0, uv = 0;
    for (size_t i = 0; i < u.size(); ++i) {
        uu += (u[i] - mean_u) * (u[i] - mean_u);
        uv += (u[i] - mean_u) * (v[i] - mean_v);
    }
    if (uu == 0) return fit;
    fit.slope = uv / uu;
    fit.intercept = mean_v - fit.slope * mean_u;
    if (fit.points < 3) return fit;
    double squares = 0;
    for (size_t i = 0; i < u.size(); ++i) {
        const double rest = v[i] - fit.intercept - fit.slope * u[i];
        squares += rest * rest;
    }
    const size_t freedom = fit.points - 2;
    fit.half_width = student_t(freedom) * std::sqrt(squares / double(freedom) / uu);
    return fit;
}

std::vector<size_t> pareto_front(std::span<const double> x, std::span<const double> y) {
    std::vector<size_t> front;
    for (size_t i = 0; i < x.size(); ++i) {
        bool is_beaten = false;
        for (size_t k = 0; k < x.size() && !is_beaten; ++k)
            is_beaten = x[k] <= x[i] && y[k] <= y[i] && (x[k] < x[i] || y[k] < y[i]);
        if (!is_beaten) front.push_back(i);
    }
    std::ranges::sort(front, {}, [&](size_t i) { return x[i]; });
    return front;
}

}  // namespace voxelume
