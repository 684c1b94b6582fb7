// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/shape/edge_turns.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

namespace voxelume {
namespace {

constexpr size_t kMaxEdges = 32;

/// The turn of a right angle over that of an edge that is just sharp.
constexpr double kRightAngle = 90 / kSharpAngle;

/// Around a rounded edge the surface bends to the edge's side alone, within this many widths on
/// each side, except for a tenth. Scans have bumps and dents there.
constexpr double kFlanks = 4, kRough = 1.1;

/// A way that turns by kMaxTurnBack degrees to the other side ends there. kEndless is larger than
/// any way's turn.
constexpr double kMaxTurnBack = 20, kEndless = 1e6;

/// The edges that are crossed on one side of an edge: `way` is the distance to each in metres,
/// `turn` the turn of the surface up to there in degrees, and `bent` the sum of unsigned turns.
/// Number 0 is the edge itself.
struct Arm {
    std::array<double, kMaxEdges + 1> way, turn, bent;  // filled as far as `count`
    size_t count = 1;
    double end = std::numeric_limits<double>::infinity();  // where it bends back too far

    Arm() { way[0] = turn[0] = bent[0] = 0; }

    /// The unsigned turn of the surface within a width.
    double bent_within(double width) const {
        size_t last = 0;
        while (last + 1 < count && way[last + 1] <= width) ++last;
        return bent[last];
    }
};

/// The turn from one face to another around an axis, in degrees.
double turn_about(const glm::dvec3& axis, const glm::dvec3& from, const glm::dvec3& to) {
    const double sine = glm::dot(axis, glm::cross(from, to));
    const double cosine = glm::dot(from, to) - glm::dot(from, axis) * glm::dot(to, axis);
    // Below 6 degrees the sine is the angle to 0.3 %.
    if (std::abs(sine) < 0.1 * cosine) return glm::degrees(sine / cosine);
    return glm::degrees(std::atan2(sine, cosine));
}

/// Walks on the surface, in the plane through `middle` that `axis` is perpendicular to.
struct Walk {
    const MeshEdges& edges;
    glm::dvec3 axis, middle;

    double height(const glm::dvec3& p) const { return glm::dot(axis, p - middle); }

    /// Goes away from `side` into its face, whose normal looks out of the surface as it is or, for
    /// a `sign` of -1, turned over. `sense` is 1 if turns around the axis count with their sign.
    /// Nothing farther away than `reach` counts.
    Arm go(uint32_t side, double sign, double sense, double own, double reach) const {
        Arm arm;
        glm::dvec3 at = middle, normal = sign * edges.normal(side);
        double way = 0, turn = 0, bent = 0, back = 0, end = reach;
        while (arm.count <= kMaxEdges && back <= kMaxTurnBack) {
            const uint32_t second = next_side(side), third = next_side(second);
            const glm::dvec3 tip = edges.start(third);
            const double above = height(tip);
            // The plane leaves through the side whose ends lie to both sides of it.
            const bool is_second = (height(edges.start(second)) < 0) != (above < 0);
            const uint32_t left = is_second ? second : third, beyond = edges.across(left);
            if (beyond == MeshEdges::kNoSide) break;
            const glm::dvec3 from = edges.start(is_second ? second : side);
            const double below = height(from);
            const glm::dvec3 on =
                below == above ? tip : glm::mix(from, tip, below / (below - above));
            way += glm::distance(at, on);
            if (way > end) break;
            sign *= edges.sense(left, beyond);
            const glm::dvec3 next = sign * edges.normal(beyond);
            if (next != glm::dvec3(0)) {
                const double here = sense * turn_about(axis, normal, next);
                turn += here;
                bent += std::abs(here);
                if (here * own < 0) back += std::abs(here);
                normal = next;
            }
            arm.way[arm.count] = way;
            arm.turn[arm.count] = turn;
            arm.bent[arm.count++] = bent;
            if (back > kMaxTurnBack) {
                arm.bent[arm.count - 1] = kEndless;
                arm.end = way;
            }
            if (std::abs(turn + own) >= kSharpAngle) end = std::min(end, kFlanks * way);
            at = on;
            side = beyond;
        }
        return arm;
    }
};

/// The smallest width around an edge of this turn in which the surface turns by kSharpAngle, in the
/// sense of the edge.
double min_width(const Arm& a, const Arm& b, double turn) {
    double min_way = std::numeric_limits<double>::infinity();
    const double sense = turn < 0 ? -1 : 1;
    for (size_t i = 0; i < a.count && a.way[i] < min_way; ++i)
        for (size_t j = 0; j < b.count && a.way[i] + b.way[j] < min_way; ++j)
            if (sense * (turn + a.turn[i] + b.turn[j]) >= kSharpAngle) {
                min_way = a.way[i] + b.way[j];
                break;
            }
    return min_way;
}

/// The largest turn around an edge within a width.
double largest_turn(const Arm& a, const Arm& b, double turn, double width) {
    double largest = std::abs(turn);
    for (size_t i = 0; i < a.count && a.way[i] <= width; ++i)
        for (size_t j = 0; j < b.count && a.way[i] + b.way[j] <= width; ++j)
            largest = std::max(largest, std::abs(turn + a.turn[i] + b.turn[j]));
    return largest;
}

}  // namespace

EdgeTurn turn_around(const MeshEdges& edges, const MeshEdge& edge, double reach) {
    if (edge.is_fork) return {0, 1};
    const glm::dvec3 low = edges.start(edge.a), high = edges.start(next_side(edge.a));
    const Walk walk{edges, glm::normalize(high - low), (low + high) / 2.0};
    const double sense = edges.sense(edge.a, edge.b);
    const double turn = turn_about(walk.axis, edges.normal(edge.a), sense * edges.normal(edge.b));
    const Arm a = walk.go(edge.a, 1, -1, turn, reach);
    // Where the first side bends back too far, everything of that width is too rough.
    const Arm b = walk.go(edge.b, sense, 1, turn, std::min(reach, a.end));
    const double width = min_width(a, b, turn);
    if (!(width < std::numeric_limits<double>::infinity())) return {};
    const double largest = largest_turn(a, b, turn, kRightAngle * width);
    const double bent =
        std::abs(turn) + a.bent_within(kFlanks * width) + b.bent_within(kFlanks * width);
    if (bent > kRough * largest_turn(a, b, turn, 2 * kFlanks * width)) return {};
    return {width, std::abs(turn) / largest};
}

}  // namespace voxelume
