// SPDX-License-Identifier: Apache-2.0
// Affine maps from the factors that scene files give: positions, turns in degrees, scales.
#include "runtime/scene/parts/scene_affine.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace voxelume {
namespace {

struct SineCosine {
    double sine;
    double cosine;
};

SineCosine sine_cosine_of_degrees(double degrees) {
    int quadrant = 0;
    const double rest = std::remquo(degrees, 90.0, &quadrant);  // exact, -45..45
    const double radians = rest * (std::numbers::pi / 180);
    const double s = std::sin(radians), c = std::cos(radians);
    switch (quadrant & 3) {
        case 0:
            return {s, c};
        case 1:
            return {c, -s};
        case 2:
            return {-s, -c};
        default:
            return {-c, s};
    }
}

}  // namespace

glm::dmat3 rotation_from_turn(glm::dvec3 turn) {
    const auto [sp, cp] = sine_cosine_of_degrees(turn.x);
    const auto [st, ct] = sine_cosine_of_degrees(turn.y);
    const auto [sg, cg] = sine_cosine_of_degrees(turn.z);
    // glm stores columns: each line below is the image of one axis.
    const glm::dmat3 about_y({cp, 0, -sp}, {0, 1, 0}, {sp, 0, cp});
    const glm::dmat3 about_x({1, 0, 0}, {0, ct, st}, {0, -st, ct});
    const glm::dmat3 about_z({cg, sg, 0}, {-sg, cg, 0}, {0, 0, 1});
    return about_y * about_x * about_z;
}

glm::dvec3 turn_from_rotation(const glm::dmat3& r) {
    const double psi = std::atan2(r[2].x, r[2].z);
    const double theta = std::atan2(-r[2].y, std::hypot(r[0].y, r[1].y));
    // Gamma is what is left when psi is undone, so an ill-determined psi doesn't matter.
    const double cp = std::cos(psi), sp = std::sin(psi);
    const double gamma = std::atan2(sp * r[1].z - cp * r[1].x, cp * r[0].x - sp * r[0].z);
    return glm::degrees(glm::dvec3(psi, theta, gamma));
}

glm::dmat4 affine_from_factors(glm::dvec3 position, glm::dvec3 turn, glm::dvec3 scale) {
    const glm::dmat3 r = rotation_from_turn(turn);
    return {glm::dvec4(r[0] * scale.x, 0), glm::dvec4(r[1] * scale.y, 0),
            glm::dvec4(r[2] * scale.z, 0), glm::dvec4(position, 1)};
}

glm::dmat4 product_of(std::span<const glm::dmat4> links) {
    glm::dmat4 map = links.front();
    for (const glm::dmat4& link : links.subspan(1)) map = map * link;
    return map;
}

// Turns pairs of columns until all are orthogonal; their lengths are then the singular values
// (one-sided Jacobi, Hestenes 1958). Convergence is quadratic: four sweeps suffice for three
// columns, eight leave no doubt.
Stretch stretch_of(const glm::dmat3& linear) {
    double largest = 0;
    for (int c = 0; c < 3; ++c) {
        for (int r = 0; r < 3; ++r) largest = std::max(largest, std::abs(linear[c][r]));
    }
    if (largest == 0) return {0, 0};
    glm::dmat3 a = linear / largest;
    for (int sweep = 0; sweep < 8; ++sweep) {
        for (int p = 0; p < 2; ++p) {
            for (int q = p + 1; q < 3; ++q) {
                const double product = glm::dot(a[p], a[q]);
                if (product == 0) continue;
                const double z = (glm::dot(a[q], a[q]) - glm::dot(a[p], a[p])) / (2 * product);
                const double t = std::copysign(1.0, z) / (std::abs(z) + std::hypot(1.0, z));
                const double c = 1 / std::hypot(1.0, t), s = c * t;
                const glm::dvec3 old = a[p];
                a[p] = c * old - s * a[q];
                a[q] = s * old + c * a[q];
            }
        }
    }
    const auto [min, max] = std::minmax({glm::length(a[0]), glm::length(a[1]), glm::length(a[2])});
    return {min * largest, max * largest};
}

std::span<const ValueRow<Factors>> factor_rows() {
    static constexpr std::array<ValueRow<Factors>, 3> rows = {
        {{"position", &Factors::position, kCoordinate},
         {"turn", &Factors::turn, kDegrees},
         {"scale", &Factors::scale, {-1e6, 1e6}, true}}};
    return rows;
}

void check_map(const glm::dmat4& map, std::string_view key, const Refuse& refuse) {
    const Stretch stretch = stretch_of(glm::dmat3(map));
    if (stretch.min < kMinStretch)
        refuse(key, "is singular: it flattens the object to nothing in one direction");
    if (stretch.max > stretch.min * kMaxCondition)
        refuse(key, fmt::format("stretches {:.3g} times as much in one direction as in another, "
                                "which is close to singular; at most {} times is allowed",
                                stretch.max / stretch.min, kMaxCondition));
}

}  // namespace voxelume
