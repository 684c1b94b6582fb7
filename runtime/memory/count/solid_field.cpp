// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/solid_field.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/matrix.hpp>

namespace voxelume {
namespace {

double length2(double x, double y) {
    return std::sqrt(x * x + y * y);
}

/// The distance to a box or a rectangle from the distances to its faces along each axis.
double corner_distance(const glm::dvec3& beyond) {
    const double inside = std::min(std::max({beyond.x, beyond.y, beyond.z}), 0.0);
    return inside + glm::length(glm::max(beyond, 0.0));
}

/// A cone is no nearer than the planes of its caps and its side's line.
double cone_distance(const glm::dvec3& p, const Solid& cone) {
    const double slope = (cone.top_radius - cone.radius) / cone.height;
    const double middle = (cone.top_radius + cone.radius) / 2;
    const double side = (length2(p.x, p.z) - middle - slope * p.y) / length2(1, slope);
    return std::max(side, std::abs(p.y) - cone.height / 2);
}

/// Exact near the surface; elsewhere limited by the distance along the shortest axis.
double ellipsoid_distance(const glm::dvec3& p, const glm::dvec3& radii) {
    const double shortest = std::min({radii.x, radii.y, radii.z});
    const double level = glm::length(p / radii), slope = glm::length(p / (radii * radii));
    const double bound = (level - 1) * shortest;
    if (!(slope > 0)) return -shortest;
    const double near = level * (level - 1) / slope;
    return std::abs(level - 1) < 0.2 ? near : bound;
}

double shape_distance(const glm::dvec3& p, const Solid& s) {
    switch (s.kind) {
        case SolidKind::ellipsoid:
            return ellipsoid_distance(p, s.radii);
        case SolidKind::box:
            return corner_distance(glm::abs(p) - s.size / 2.0);
        case SolidKind::cylinder:
            return corner_distance(
                {length2(p.x, p.z) - s.radius, std::abs(p.y) - s.height / 2, -INFINITY});
        case SolidKind::cone:
            return cone_distance(p, s);
        case SolidKind::torus:
            return length2(length2(p.x, p.z) - s.radius, p.y) - s.tube;
        case SolidKind::capsule:
            return glm::length(glm::dvec3(p.x, std::max(std::abs(p.y) - s.height / 2, 0.0), p.z)) -
                   s.radius;
        case SolidKind::slab:
            return std::abs(p.y) - s.thickness / 2;
        default:
            return glm::length(p) - s.radius;
    }
}

/// A lower bound on the length that a map gives to a unit vector: one over an upper bound on the
/// length that its inverse gives.
double min_stretch(const glm::dmat4& inverse) {
    const glm::dmat3 turn(inverse);
    const double columns = std::sqrt(glm::dot(turn[0], turn[0]) + glm::dot(turn[1], turn[1]) +
                                     glm::dot(turn[2], turn[2]));
    const glm::dvec3 lengths(glm::length(turn[0]), glm::length(turn[1]), glm::length(turn[2]));
    const double largest = std::max({lengths.x, lengths.y, lengths.z});
    // Perpendicular columns stretch no vector more than the longest of them.
    const double askew =
        std::max({std::abs(glm::dot(turn[0], turn[1])), std::abs(glm::dot(turn[1], turn[2])),
                  std::abs(glm::dot(turn[2], turn[0]))});
    return 1 / (askew < 1e-9 * largest * largest ? largest : columns);
}

}  // namespace

SolidField::SolidField(const Solid& solid, const glm::dmat4& frame_from_solid) {
    add(solid, frame_from_solid);
}

void SolidField::add(const Solid& solid, const glm::dmat4& frame_from_parent) {
    const glm::dmat4 map = frame_from_parent * solid.parent_from_solid;
    const size_t number = nodes_.size();
    nodes_.emplace_back();
    nodes_[number].shape = solid;
    nodes_[number].shape.parts.clear();
    nodes_[number].shape_from_frame = glm::inverse(map);
    nodes_[number].scale = min_stretch(nodes_[number].shape_from_frame);
    for (const Solid& part : solid.parts) add(part, map);
    nodes_[number].end = uint32_t(nodes_.size());
}

double SolidField::distance(uint32_t number, const glm::dvec3& p) const {
    const Node& node = nodes_[number];
    const SolidKind kind = node.shape.kind;
    if (!is_combination(kind))
        return shape_distance(glm::dvec3(node.shape_from_frame * glm::dvec4(p, 1)), node.shape) *
               node.scale;
    double sum = distance(number + 1, p);
    for (uint32_t part = nodes_[number + 1].end; part < node.end; part = nodes_[part].end) {
        const double of_part = distance(part, p);
        sum = kind == SolidKind::union_of          ? std::min(sum, of_part)
              : kind == SolidKind::intersection_of ? std::max(sum, of_part)
                                                   : std::max(sum, -of_part);
    }
    return sum;
}

}  // namespace voxelume
