// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/reconstruction_filter.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace voxelume {
namespace {

using std::numbers::pi;

double box_weight(double x) {
    return x;
}

double tent_weight(double x) {
    return 2 * x * (1 - x);
}

// Three standard deviations lie on each side, and the curve is lowered to 0 at its ends.
double gaussian_weight(double x) {
    const double end = std::exp(-4.5), root = std::sqrt(18.0);
    const auto weight = [&](double to) {
        return std::sqrt(pi) / 2 / root * std::erf(root * to) - end * to;
    };
    return 0.5 * weight(x) / weight(0.5);
}

// The window of four terms of Harris 1978 whose side lobes are lowest.
double blackman_harris_weight(double x) {
    return x +
           (0.48829 / (2 * pi) * std::sin(2 * pi * x) + 0.14128 / (4 * pi) * std::sin(4 * pi * x) +
            0.01168 / (6 * pi) * std::sin(6 * pi * x)) /
               0.35875;
}

constexpr std::array<FilterRow, 4> kFilters = {
    {{"box", 1, box_weight, 1},
     {"tent", 2, tent_weight, 0.75},
     {"gaussian", 3, gaussian_weight, 0.57449},
     {"blackman-harris", 3, blackman_harris_weight, 0.49891}}};

}  // namespace

std::span<const FilterRow> filter_rows() {
    return kFilters;
}

const FilterRow& filter_row(const ReconstructionFilter& filter) {
    return kFilters[size_t(filter.shape)];
}

double filter_offset(const ReconstructionFilter& filter, double share) {
    const double wanted = std::abs(share - 0.5);
    if (wanted == 0) return 0;
    const FilterRow& row = filter_row(filter);
    double low = 0, high = 0.5;
    for (int step = 0; step < 60; ++step) {
        const double middle = (low + high) / 2;
        (row.weight_to(middle) < wanted ? low : high) = middle;
    }
    return std::copysign((low + high) / 2, share - 0.5) * filter.width;
}

Display with_filter_margin(Display display, const ReconstructionFilter& filter, glm::ivec2 frame) {
    const glm::dvec2 scale = 1.0 + std::max(filter.width - 1, 0.0) / glm::dvec2(frame);
    if (const auto widen = shape_row(display).widen) widen(display, scale);
    return display;
}

}  // namespace voxelume
