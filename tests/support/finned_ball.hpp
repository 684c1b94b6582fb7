// SPDX-License-Identifier: Apache-2.0
// A closed mesh with a thin part: a ball with a fin around it, joined by fillets.
#pragma once

#include <algorithm>
#include <glm/vec2.hpp>
#include <vector>

#include "tests/support/test_meshes.hpp"

namespace voxelume {

/// The mesh of an outline (distance from the axis, y) that turns around the Y axis. It begins at
/// the lower and ends at the upper point on the axis.
inline Mesh turned_outline(const std::vector<glm::dvec2>& outline, int around) {
    Mesh mesh;
    const auto last = uint32_t(outline.size() - 1);
    mesh.positions.emplace_back(0, outline.front().y, 0);
    for (uint32_t i = 1; i < last; ++i)
        for (int j = 0; j < around; ++j) {
            const double a = 2 * std::numbers::pi * j / around;
            mesh.positions.emplace_back(outline[i].x * std::cos(a), outline[i].y,
                                        outline[i].x * std::sin(a));
        }
    mesh.positions.emplace_back(0, outline.back().y, 0);
    const auto top = uint32_t(mesh.positions.size() - 1);
    const auto at = [&](uint32_t i, int j) {
        return i == 0      ? 0u
               : i == last ? top
                           : 1 + (i - 1) * uint32_t(around) + uint32_t(j % around);
    };
    for (uint32_t i = 0; i < last; ++i)
        for (int j = 0; j < around; ++j) {
            if (i > 0) mesh.triangles.emplace_back(at(i, j), at(i + 1, j), at(i, j + 1));
            if (i + 1 < last)
                mesh.triangles.emplace_back(at(i, j + 1), at(i + 1, j), at(i + 1, j + 1));
        }
    return mesh;
}

/// A ball of radius 0.5 with a fin of this thickness, out to `reach` from its middle.
inline Mesh finned_ball(double thickness, double reach = 0.6, int around = 96) {
    constexpr double kRadius = 0.5, kFillet = 0.05, kPi = std::numbers::pi;
    const double y = thickness / 2 + kFillet;
    const double x = std::sqrt((kRadius + kFillet) * (kRadius + kFillet) - y * y);
    const double touching = std::atan2(y, x);
    std::vector<glm::dvec2> half;  // from the upper pole to the fin's rim
    const auto add_arc = [&](const glm::dvec2& center, double radius, double from, double to,
                             int steps) {
        for (int i = 0; i <= steps; ++i) {
            const double a = from + (to - from) * i / steps;
            half.push_back(center + radius * glm::dvec2(std::cos(a), std::sin(a)));
        }
    };
    add_arc({0, 0}, kRadius, kPi / 2, touching, 24);
    half.pop_back();
    add_arc({x, y}, kFillet, touching + kPi, 1.5 * kPi, 8);
    add_arc({reach, 0}, thickness / 2, kPi / 2, 0, 4);
    std::vector<glm::dvec2> outline;
    for (const glm::dvec2& p : half) outline.emplace_back(p.x, -p.y);
    for (size_t i = half.size() - 1; i-- > 0;) outline.push_back(half[i]);
    return turned_outline(outline, around);
}

/// A ball of radius 0.5 with a blade of this thickness that stands out of its top.
inline Mesh bladed_ball(double thickness) {
    const auto half = float(thickness / 2);
    Mesh mesh = ball({0, 0, 0}, 0.5, 48, 24);
    const Mesh blade = box({-half, 0.49f, -0.025f}, {half, 0.555f, 0.025f});
    const auto first = uint32_t(mesh.positions.size());
    mesh.positions.insert(mesh.positions.end(), blade.positions.begin(), blade.positions.end());
    for (const glm::uvec3& t : blade.triangles) mesh.triangles.push_back(t + first);
    return mesh;
}

}  // namespace voxelume
