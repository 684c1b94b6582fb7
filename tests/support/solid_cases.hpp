// SPDX-License-Identifier: Apache-2.0
// Analytic solids to test with: every kind, turned by a rational rotation, and combinations.
#pragma once

#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <vector>

#include "runtime/scene/parts/solid.hpp"

namespace voxelume {

/// The rotation of the quaternion (a,b,c,d): its entries are whole numbers over a²+b²+c²+d².
inline glm::dmat4 rational_rotation(int a, int b, int c, int d) {
    const double n = a * a + b * b + c * c + d * d;
    glm::dmat4 m(1);
    m[0] =
        glm::dvec4(a * a + b * b - c * c - d * d, 2 * (b * c + a * d), 2 * (b * d - a * c), 0) / n;
    m[1] =
        glm::dvec4(2 * (b * c - a * d), a * a - b * b + c * c - d * d, 2 * (c * d + a * b), 0) / n;
    m[2] =
        glm::dvec4(2 * (b * d + a * c), 2 * (c * d - a * b), a * a - b * b - c * c + d * d, 0) / n;
    return m;
}

inline glm::dmat4 moved(glm::dmat4 map, const glm::dvec3& by) {
    map[3] += glm::dvec4(by, 0);
    return map;
}

inline glm::dmat4 stretched(const glm::dmat4& map, const glm::dvec3& by) {
    return {map[0] * by.x, map[1] * by.y, map[2] * by.z, map[3]};
}

inline Solid combined(SolidKind kind, std::vector<Solid> parts) {
    Solid solid;
    solid.kind = kind;
    solid.parts = std::move(parts);
    return solid;
}

struct SolidCase {
    std::string name;
    Solid solid;
};

/// One of each kind, about 20 metres large, with three different lengths where it has them.
inline std::vector<SolidCase> shape_cases() {
    Solid s;
    s.parent_from_solid = moved(rational_rotation(1, 2, 3, 4), {0.3, -0.7, 1.1});
    s.radius = 9.3, s.top_radius = 4.1, s.tube = 2.7, s.height = 14.6, s.thickness = 5.3;
    s.radii = {11.2, 6.7, 4.9}, s.size = {19.4, 11.8, 7.3};
    std::vector<SolidCase> cases;
    const char* names[] = {"sphere", "ellipsoid", "box",     "cylinder",
                           "cone",   "torus",     "capsule", "slab"};
    for (int kind = 0; kind < 8; ++kind) {
        s.kind = static_cast<SolidKind>(kind);
        cases.push_back({names[kind], s});
    }
    s.kind = SolidKind::cone;
    s.top_radius = 0;
    cases.push_back({"pointed cone", s});
    return cases;
}

/// A lens of two balls, a box with a bored hole, and a tree of all operations.
inline std::vector<SolidCase> combination_cases() {
    Solid left, right, box, bore, ball;
    left.radius = 13, left.parent_from_solid = moved(glm::dmat4(1), {-8, 0.4, 0.2});
    right.radius = 11, right.parent_from_solid = moved(glm::dmat4(1), {6.5, -0.3, 0.1});
    box.kind = SolidKind::box, box.size = {18, 10, 14};
    box.parent_from_solid = rational_rotation(2, 1, 0, 3);
    bore.kind = SolidKind::cylinder, bore.radius = 3.5, bore.height = 20;
    bore.parent_from_solid = rational_rotation(2, 1, 0, 3);
    ball.radius = 4.2, ball.parent_from_solid = moved(glm::dmat4(1), {5, 5, -4});
    const Solid bored = combined(SolidKind::difference_of, {box, bore});
    return {{"lens", combined(SolidKind::intersection_of, {left, right})},
            {"bored box", bored},
            {"bored box with a ball, without a lens",
             combined(SolidKind::difference_of,
                      {combined(SolidKind::union_of, {bored, ball}),
                       combined(SolidKind::intersection_of, {left, right, ball})})}};
}

}  // namespace voxelume
