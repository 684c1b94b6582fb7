// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/solid_membership.hpp"

#include <algorithm>
#include <array>

#include "runtime/base/exact_sum.hpp"

namespace voxelume {
namespace {

using Point = std::array<ExactSum, 3>;

Point in_shape_space(const SourceShape& source, const glm::ivec3& half_voxels) {
    Point p;
    for (int row = 0; row < 3; ++row) {
        p[row] = ExactSum(source.offset[row]);
        for (int axis = 0; axis < 3; ++axis)
            p[row] += ExactSum(source.linear[axis][row]) * (0.5 * half_voxels[axis]);
    }
    return p;
}

ExactSum twice_magnitude(const ExactSum& a) {
    return a * (a.sign() < 0 ? -2.0 : 2.0);
}

/// The sign of |a| - edge/2.
int side_of_pair(const ExactSum& a, double edge) {
    return (twice_magnitude(a) - edge).sign();
}

int side_of_ellipsoid(const Point& p, const glm::dvec3& radii) {
    const ExactSum x = p[0] * radii.y * radii.z, y = p[1] * radii.z * radii.x,
                   z = p[2] * radii.x * radii.y;
    return (square(x) + square(y) + square(z) - square(ExactSum(radii.x) * radii.y * radii.z))
        .sign();
}

/// The side of a cone. Its radius at y is ((r0 + r1) h + 2 (r1 - r0) y) / 2h.
int side_of_cone(const Point& p, const Solid& cone) {
    const ExactSum sum = ExactSum(cone.radius) + ExactSum(cone.top_radius);
    const ExactSum growth = ExactSum(cone.top_radius) - ExactSum(cone.radius);
    const ExactSum radius_2h = sum * cone.height + growth * p[1] * 2.0;
    const ExactSum across = (square(p[0]) + square(p[2])) * cone.height * cone.height * 4.0;
    return std::max(side_of_pair(p[1], cone.height), (across - square(radius_2h)).sign());
}

int side_of_torus(const Point& p, const Solid& torus) {
    const ExactSum across = square(p[0]) + square(p[2]);
    const ExactSum ring = square(ExactSum(torus.radius));
    const ExactSum sum = across + square(p[1]) + ring - square(ExactSum(torus.tube));
    return (square(sum) - ring * across * 4.0).sign();
}

int side_of_capsule(const Point& p, double radius, double height) {
    const ExactSum across = square(p[0]) + square(p[2]);
    const ExactSum beyond = twice_magnitude(p[1]) - height;
    const ExactSum squared = beyond.sign() > 0 ? across * 4.0 + square(beyond) : across * 4.0;
    return (squared - square(ExactSum(radius)) * 4.0).sign();
}

int side_of_shape(const SourceShape& source, const glm::ivec3& half_voxels) {
    const Solid& s = source.solid;
    const Point p = in_shape_space(source, half_voxels);
    switch (s.kind) {
        case SolidKind::ellipsoid:
            return side_of_ellipsoid(p, s.radii);
        case SolidKind::box:
            return std::max({side_of_pair(p[0], s.size.x), side_of_pair(p[1], s.size.y),
                             side_of_pair(p[2], s.size.z)});
        case SolidKind::cylinder:
            return std::max(side_of_pair(p[1], s.height),
                            (square(p[0]) + square(p[2]) - square(ExactSum(s.radius))).sign());
        case SolidKind::cone:
            return side_of_cone(p, s);
        case SolidKind::torus:
            return side_of_torus(p, s);
        case SolidKind::capsule:
            return side_of_capsule(p, s.radius, s.height);
        case SolidKind::slab:
            return side_of_pair(p[1], s.thickness);
        default:
            return (square(p[0]) + square(p[1]) + square(p[2]) - square(ExactSum(s.radius))).sign();
    }
}

}  // namespace

int exact_side(const SolidProgram& program, const glm::ivec3& half_voxels) {
    std::array<int, VXL_SOLID_STACK> stack{};
    int depth = 0;
    for (const SourceShape& source : program.sources) {
        const int side = side_of_shape(source, half_voxels);
        stack[depth++] = source.is_complement ? -side : side;
        for (uint32_t left = source.operations; left != 0; left >>= VXL_SOLID_OPERATION_BITS) {
            const int top = stack[--depth];
            int& below = stack[depth - 1];
            below = (left & VXL_SOLID_OPERATION_MASK) == VXL_SOLID_UNION ? std::min(below, top)
                                                                         : std::max(below, top);
        }
    }
    return stack[0];
}

}  // namespace voxelume
