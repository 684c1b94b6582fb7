// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/solid/shape_map.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>
#include <limits>
#include <optional>

namespace voxelume {
namespace {

// The tolerance within which lengths are equal and angles right: a few roundings of double. Such a
// map differs from the ideal one by less than the float coordinates in which it is stored.
constexpr double kDoubleRoundings = 64 * std::numeric_limits<double>::epsilon();

bool are_equal(double a, double b) {
    return std::abs(a - b) <= kDoubleRoundings * std::max(std::abs(a), std::abs(b));
}

bool are_perpendicular(const glm::dvec3& a, const glm::dvec3& b) {
    return std::abs(glm::dot(a, b)) <= kDoubleRoundings * glm::length(a) * glm::length(b);
}

bool has_perpendicular_columns(const glm::dmat3& m) {
    return are_perpendicular(m[0], m[1]) && are_perpendicular(m[1], m[2]) &&
           are_perpendicular(m[2], m[0]);
}

/// Turns the columns until they are perpendicular: m * V = U * S (one-sided Jacobi, Hestenes 1958).
/// Small singular values keep their relative accuracy, which the eigenvalues of m * mT would lose.
glm::dmat3 with_perpendicular_columns(glm::dmat3 m) {
    constexpr int kMaxSweeps = 30;  // a 3x3 matrix needs up to six
    for (int sweep = 0; sweep < kMaxSweeps && !has_perpendicular_columns(m); ++sweep)
        for (int p = 0; p < 2; ++p)
            for (int q = p + 1; q < 3; ++q) {
                const double inner = glm::dot(m[p], m[q]);
                if (inner == 0) continue;
                const double zeta = (glm::dot(m[q], m[q]) - glm::dot(m[p], m[p])) / (2 * inner);
                const double tangent =
                    std::copysign(1.0, zeta) / (std::abs(zeta) + std::hypot(1.0, zeta));
                const double cosine = 1 / std::hypot(1.0, tangent), sine = cosine * tangent;
                const glm::dvec3 column = cosine * m[p] - sine * m[q];
                m[q] = sine * m[p] + cosine * m[q];
                m[p] = column;
            }
    return m;
}

glm::dvec3 column_lengths(const glm::dmat3& m) {
    return {glm::length(m[0]), glm::length(m[1]), glm::length(m[2])};
}

/// The inverse of the rotation or reflection whose columns have these directions.
glm::dmat3 into_axes(const glm::dmat3& m, const glm::dvec3& lengths) {
    return glm::transpose(glm::dmat3(m[0] / lengths.x, m[1] / lengths.y, m[2] / lengths.z));
}

glm::dvec3 stated_size(const Solid& shape) {
    switch (shape.kind) {
        case SolidKind::ellipsoid:
            return shape.radii;
        case SolidKind::box:
            return 0.5 * shape.size;
        case SolidKind::cylinder:
        case SolidKind::capsule:
            return {shape.radius, 0.5 * shape.height, 0};
        case SolidKind::cone:
            return {shape.radius, 0.5 * shape.height, shape.top_radius};
        case SolidKind::torus:
            return {shape.radius, shape.tube, 0};
        case SolidKind::slab:
            return {0.5 * shape.thickness, 0, 0};
        default:
            return glm::dvec3(shape.radius);
    }
}

/// Maps a ball or an ellipsoid. Every linear image of either is one again.
ShapeMap map_ellipsoid(const glm::dvec3& half_axes, const glm::dmat3& map) {
    const glm::dmat3 axes = with_perpendicular_columns(
        glm::dmat3(map[0] * half_axes.x, map[1] * half_axes.y, map[2] * half_axes.z));
    const glm::dvec3 lengths = column_lengths(axes);
    if (are_equal(lengths.x, lengths.y) && are_equal(lengths.y, lengths.z))
        return {SolidKind::sphere, {lengths.x, 0, 0}, glm::dmat3(1)};
    return {SolidKind::ellipsoid, lengths, into_axes(axes, lengths)};
}

/// Maps a slab. Every linear image of a slab is a slab; only the Y axis of its space is used.
ShapeMap map_slab(double half_thickness, const glm::dmat3& map) {
    const glm::dvec3 across = glm::transpose(glm::inverse(map)) * glm::dvec3(0, 1, 0);
    const double length = glm::length(across);
    glm::dmat3 from_frame(0);
    for (int axis = 0; axis < 3; ++axis) from_frame[axis].y = across[axis] / length;
    return {SolidKind::slab, {half_thickness / length, 0, 0}, from_frame};
}

/// The sizes of the other kinds after the map. Empty if the map doesn't keep the kind.
std::optional<glm::dvec3> kept_size(SolidKind kind, const glm::dvec3& size, const glm::dmat3& map) {
    const glm::dvec3 scale = column_lengths(map);
    if (!has_perpendicular_columns(map)) return std::nullopt;
    if (kind == SolidKind::box) return size * scale;
    if (!are_equal(scale.x, scale.z)) return std::nullopt;
    if (kind == SolidKind::cylinder || kind == SolidKind::cone)
        return glm::dvec3(size[0] * scale.x, size[1] * scale.y, size[2] * scale.x);
    if (!are_equal(scale.x, scale.y)) return std::nullopt;
    return size * scale.x;
}

}  // namespace

double smallest_singular_value(const glm::dmat3& map) {
    const glm::dvec3 lengths = column_lengths(with_perpendicular_columns(map));
    return std::min({lengths.x, lengths.y, lengths.z});
}

ShapeMap map_shape(const Solid& shape, const glm::dmat3& frame_from_shape) {
    const glm::dvec3 size = stated_size(shape);
    if (shape.kind == SolidKind::sphere || shape.kind == SolidKind::ellipsoid)
        return map_ellipsoid(size, frame_from_shape);
    if (shape.kind == SolidKind::slab) return map_slab(size[0], frame_from_shape);
    if (const auto kept = kept_size(shape.kind, size, frame_from_shape))
        return {shape.kind, *kept, into_axes(frame_from_shape, column_lengths(frame_from_shape))};
    const double scale = smallest_singular_value(frame_from_shape);
    return {shape.kind, size * scale, glm::inverse(frame_from_shape) * scale};
}

}  // namespace voxelume
