// SPDX-License-Identifier: Apache-2.0
// Computes what smooth surfaces enclose by quadrature over the zero of every voxel's field.
//
// The field is a quadratic along every axis, so it is kept as its values at the 27 points whose
// coordinates are 0, 1/2 and 1. The surface is summed over columns along the axis on which the
// field changes most, by Gauss's rule between the points where the surface leaves through other
// sides (the reduction of dimensions of Saye 2015). Voxels that it crosses too steeply are cut in
// eight.
#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <vector>

#include "kernels/shared/voxel.h"
#include "runtime/verify/analytic/pixel_contour.hpp"
#include "runtime/verify/bench/bench_extent.hpp"
#include "runtime/verify/bench/pyramid_voxels.hpp"

namespace voxelume {
namespace {

using Three = std::array<double, 3>;  ///< values, or weights of values, at 0, 1/2 and 1
using Nine = std::array<double, 9>;

Three weights_at(double s) {
    return {(1 - s) * (1 - 2 * s), 4 * s * (1 - s), s * (2 * s - 1)};
}
Three slopes_at(double s) {
    return {4 * s - 3, 4 - 8 * s, 4 * s - 1};
}
double sum_of(const Three& weights, double a, double b, double c) {
    return weights[0] * a + weights[1] * b + weights[2] * c;
}

/// The Bernstein coefficients of a quadratic. It stays between their extremes in 0..1.
Three bernstein(double a, double b, double c) {
    return {a, 2 * b - (a + c) / 2, c};
}

/// Appends the zeros of a quadratic in [0, 1), given by its values, to `zeros`. A zero at 1 belongs
/// to the next voxel.
void add_zeros(double v0, double v1, double v2, std::vector<double>& zeros) {
    const double a = 2 * (v0 + v2) - 4 * v1, b = 4 * v1 - 3 * v0 - v2, c = v0;
    const double square = b * b - 4 * a * c;
    if (square < 0) return;
    const double q = -(b + std::copysign(std::sqrt(square), b)) / 2;
    for (const double zero : {a != 0 ? q / a : -1.0, q != 0 ? c / q : -1.0})
        if (zero >= 0 && zero < 1) zeros.push_back(zero);
}

/// A part of a voxel: a cube in the part's voxels, with the field's values.
struct Cell {
    std::array<double, 27> values;  ///< x fastest, then y, then z
    glm::dvec3 corner;
    double edge = 1;
};

constexpr size_t kStride[] = {1, 3, 9};

/// Sums the values along `axis` with `weights`. The other two axes follow in cyclic order.
Nine contract(const Cell& cell, int axis, const Three& weights) {
    const size_t step = kStride[axis], j = kStride[(axis + 1) % 3], k = kStride[(axis + 2) % 3];
    Nine sums;
    for (size_t b = 0; b < 3; ++b)
        for (size_t a = 0; a < 3; ++a) {
            const double* v = &cell.values[a * j + b * k];
            sums[a + 3 * b] = sum_of(weights, v[0], v[step], v[2 * step]);
        }
    return sums;
}

/// Sums the values along their first axis with `weights`.
Three contract(const Nine& values, const Three& weights) {
    Three sums;
    for (size_t b = 0; b < 3; ++b)
        sums[b] = sum_of(weights, values[3 * b], values[3 * b + 1], values[3 * b + 2]);
    return sums;
}

double at(const Three& values, const Three& weights) {
    return sum_of(weights, values[0], values[1], values[2]);
}

/// The part of a cell that is half of it along every axis.
Cell part_of(const Cell& cell, const glm::ivec3& half) {
    Cell part;
    part.edge = cell.edge / 2;
    part.corner = cell.corner + part.edge * glm::dvec3(half);
    for (size_t i = 0; i < 27; ++i) {
        const glm::dvec3 p = (glm::dvec3(half) + 0.5 * glm::dvec3(i % 3, i / 3 % 3, i / 9)) / 2.0;
        part.values[i] =
            at(contract(contract(cell, 0, weights_at(p.x)), weights_at(p.y)), weights_at(p.z));
    }
    return part;
}

/// Bounds of the field: the minimum and maximum of its Bernstein coefficients along all axes.
glm::dvec2 bounds_of(const std::array<double, 27>& values) {
    std::array<double, 27> v = values;
    for (const size_t step : kStride)
        for (size_t i = 0; i < 27; ++i) {
            if (i / step % 3 != 0) continue;
            const Three b = bernstein(v[i], v[i + step], v[i + 2 * step]);
            for (size_t n = 0; n < 3; ++n) v[i + n * step] = b[n];
        }
    const auto [low, high] = std::ranges::minmax(v);
    return {low, high};
}

/// The values of the field's slope along an axis at the 27 points.
std::array<double, 27> slope_values(const Cell& cell, int axis) {
    std::array<double, 27> slopes;
    const size_t step = kStride[axis];
    for (size_t i = 0; i < 27; ++i) {
        const size_t n = i / step % 3;
        const double* v = &cell.values[i - n * step];
        slopes[i] = sum_of(slopes_at(double(n) / 2), v[0], v[step], v[2 * step]);
    }
    return slopes;
}

glm::dvec3 middle_gradient(const Cell& cell) {
    const auto& v = cell.values;
    return {v[14] - v[12], v[16] - v[10], v[22] - v[4]};
}

/// Applies Gauss's rule to each of the pieces into which `cuts` divides 0..1.
template <class Visit>
void for_pieces(std::vector<double>& cuts, const Visit& visit) {
    constexpr double kNodes[] = {0.1127016653792583, 0.5, 0.8872983346207417};
    constexpr double kWeights[] = {5.0 / 18, 8.0 / 18, 5.0 / 18};
    cuts.push_back(1);
    std::ranges::sort(cuts);
    double from = 0;
    for (const double to : cuts) {
        for (size_t i = 0; i < 3 && to > from; ++i)
            visit(from + (to - from) * kNodes[i], (to - from) * kWeights[i]);
        from = to;
    }
}

class SurfaceSum {
  public:
    explicit SurfaceSum(const glm::dvec3& middle) : middle_(middle) {}

    void add(const Cell& cell, int cuts_left) {
        // The minimum slope anywhere in the cell, as a share of the gradient at its middle.
        constexpr double kMinShare = 0.35;
        const glm::dvec2 bounds = bounds_of(cell.values);
        if (bounds.x > 0 || bounds.y < 0) return;
        const glm::dvec3 gradient = glm::abs(middle_gradient(cell));
        const int axis = gradient.x >= gradient.y && gradient.x >= gradient.z ? 0
                         : gradient.y >= gradient.z                           ? 1
                                                                              : 2;
        if (cuts_left > 0) {
            const glm::dvec2 slopes = bounds_of(slope_values(cell, axis));
            const double minimum = std::max(slopes.x, -slopes.y);
            if (minimum < kMinShare * glm::length(gradient)) {
                for (int i = 0; i < 8; ++i)
                    add(part_of(cell, {i & 1, i >> 1 & 1, i >> 2}), cuts_left - 1);
                return;
            }
        }
        add_columns(cell, axis);
    }

    Extent extent() const { return {volume_, area_}; }

  private:
    /// Adds the columns along `axis`; the next two axes i and j lie across.
    void add_columns(const Cell& cell, int axis) {
        const int i = (axis + 1) % 3, j = (axis + 2) % 3;
        std::vector<double> cuts;
        for (const size_t a : {0, 2})
            for (const size_t b : {0, 2}) {
                const double* v = &cell.values[a * kStride[j] + b * kStride[axis]];
                add_zeros(v[0], v[kStride[i]], v[2 * kStride[i]], cuts);
            }
        for_pieces(cuts, [&](double s, double weight) {
            const Nine face = contract(cell, i, weights_at(s));  // j first, then axis
            const Nine slopes = contract(cell, i, slopes_at(s));
            std::vector<double> turns;
            add_zeros(face[0], face[1], face[2], turns);
            add_zeros(face[6], face[7], face[8], turns);
            for_pieces(turns, [&](double t, double share) {
                const Three column = contract(face, weights_at(t));
                std::vector<double> zeros;
                add_zeros(column[0], column[1], column[2], zeros);
                for (const double zero : zeros) {
                    glm::dvec3 gradient, point;
                    gradient[axis] = at(column, slopes_at(zero));
                    gradient[i] = at(contract(slopes, weights_at(t)), weights_at(zero));
                    gradient[j] = at(contract(face, slopes_at(t)), weights_at(zero));
                    point[axis] = zero, point[i] = s, point[j] = t;
                    add_point(cell.corner + cell.edge * point, gradient, axis,
                              weight * share * cell.edge * cell.edge);
                }
            });
        });
    }

    void add_point(const glm::dvec3& p, const glm::dvec3& gradient, int axis, double base) {
        const double across = std::abs(gradient[axis]);
        if (across == 0) return;
        area_ += base * glm::length(gradient) / across;
        volume_ += base * glm::dot(p - middle_, gradient) / (3 * across);
    }

    glm::dvec3 middle_;
    double volume_ = 0, area_ = 0;
};

/// Half of an edge's D, decoded from its ten bits.
double half_curvature(uint32_t word, int first) {
    const uint32_t bits = word >> first & 0x3FF, size = bits & 0x1FF;
    const double length = std::ldexp(64.0 + (size & 63), int(size >> 6)) - 64;
    return (bits >> 9 != 0 ? -length : length) / 2;
}

/// The values of a voxel's record at the 27 points, by the formula in shared/voxel.h.
std::array<double, 27> field_values(const uint32_t* record) {
    // A surface that lies in a side of voxels would, by rounding, belong to both voxels or to none.
    constexpr double kOffset = 1e-6;  // distance units: 1e-10 voxel
    std::array<double, 27> values;
    for (size_t i = 0; i < 27; ++i) {
        const size_t index[] = {i % 3, i / 3 % 3, i / 9};
        const double s[] = {0.5 * double(index[0]), 0.5 * double(index[1]), 0.5 * double(index[2])};
        const auto share = [&](int axis, uint32_t end) { return end != 0 ? s[axis] : 1 - s[axis]; };
        double value = kOffset;
        for (uint32_t n = 0; n < 4; ++n) {
            const double yz = share(1, n & 1) * share(2, n >> 1);
            const double xz = share(0, n & 1) * share(2, n >> 1);
            const double xy = share(0, n & 1) * share(1, n >> 1);
            value += yz * (share(0, 0) * int16_t(record[n] & 0xFFFF) +
                           share(0, 1) * int16_t(record[n] >> 16));
            const uint32_t edges = record[4 + n];
            value += s[0] * (1 - s[0]) * yz * half_curvature(edges, 0) +
                     s[1] * (1 - s[1]) * xz * half_curvature(edges, 10) +
                     s[2] * (1 - s[2]) * xy * half_curvature(edges, 20);
        }
        values[i] = value;
    }
    return values;
}

}  // namespace

Extent smooth_extent(const Pyramid& pyramid) {
    constexpr int kCuts = 2;
    const PyramidPart part = shown_part(pyramid);
    const std::vector<uint32_t> fields = pyramid.fields.read();
    std::vector<std::pair<glm::ivec3, uint32_t>> voxels;
    for_voxels(pyramid, part,
               [&](const glm::ivec3& v, uint32_t number) { voxels.emplace_back(v, number); });
    // Groups of voxels are summed separately, so that the sum doesn't depend on the threads.
    constexpr size_t kGroup = 4096;
    std::vector<Extent> sums((voxels.size() + kGroup - 1) / kGroup);
    for_rows(int(sums.size()), [&](int group) {
        SurfaceSum sum(glm::dvec3(part.frame.size) / 2.0);
        const size_t end = std::min(voxels.size(), (size_t(group) + 1) * kGroup);
        for (size_t i = size_t(group) * kGroup; i < end; ++i) {
            const auto& [voxel, number] = voxels[i];
            sum.add({field_values(&fields[size_t(number) * VXL_FIELD_WORDS]), glm::dvec3(voxel), 1},
                    kCuts);
        }
        sums[size_t(group)] = sum.extent();
    });
    Extent extent;
    for (const Extent& sum : sums) extent.volume += sum.volume, extent.area += sum.area;
    return extent;
}

}  // namespace voxelume
