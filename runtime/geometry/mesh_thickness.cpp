// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_thickness.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "runtime/geometry/mesh_summary.hpp"

namespace voxelume {
namespace {

constexpr int kLines = 64;

/// How many crossings an axis may have: 1,024 for each line. A mesh with more layers has no
/// inside.
constexpr size_t kMaxCrossings = size_t{1} << 22;

/// Lines lie off the middles of their squares, where few meshes have edges.
constexpr double kOffset = 0.4142135623730950;

/// Where a mesh's vertices lie between the lines along each axis: twice a line's number for those
/// on it, one more for those behind it. Most triangles of large meshes lie between the same lines.
class Places {
  public:
    Places(const Mesh& mesh, const Bounds& box) {
        const glm::dvec3 step =
            glm::max((box.max - box.min) / double(kLines), std::numeric_limits<double>::min());
        places_.reserve(mesh.positions.size());
        glm::i16vec3 place;
        for (const glm::vec3& position : mesh.positions) {
            const glm::dvec3 p = (glm::dvec3(position) - box.min) / step - kOffset;
            const glm::ivec3 whole(p);
            for (int axis = 0; axis < 3; ++axis)
                place[axis] =
                    int16_t(2 * whole[axis] + (p[axis] > whole[axis]) - (p[axis] < whole[axis]));
            places_.push_back(place);
        }
    }

    /// Whether some line of those that lie side by side along `axis` may cross the triangle.
    bool may_cross(const glm::uvec3& t, int axis) const {
        const auto [low, high] =
            std::minmax({places_[t.x][axis], places_[t.y][axis], places_[t.z][axis]});
        return low < high || low % 2 == 0;
    }

  private:
    std::vector<glm::i16vec3> places_;
};

struct Crossing {
    size_t line = 0;
    size_t number = 0;        ///< in the order of the triangles
    double at = 0;            ///< along the axis
    double normal = 0;        ///< the face's normal along the axis, 1 if it looks forwards
    bool turns_here = false;  ///< its normal is more along this axis than along the others
};

/// A chord of the body, with the area of the face that it stands for.
struct Chord {
    double thickness, area;
};

/// The lines along one axis.
class AxisLines {
  public:
    AxisLines(const Bounds& box, int axis) : axis_(axis), u_((axis + 1) % 3), v_((axis + 2) % 3) {
        low_ = {box.min[u_], box.min[v_]};
        step_ = glm::dvec2(box.max[u_] - low_.x, box.max[v_] - low_.y) / double(kLines);
    }

    void cross(const std::array<glm::dvec3, 3>& corners) {
        const glm::dvec3 normal = glm::cross(corners[1] - corners[0], corners[2] - corners[0]);
        const double length = glm::length(normal);
        if (normal[axis_] == 0 || step_.x <= 0 || step_.y <= 0 || is_full()) return;
        std::array<glm::dvec2, 3> p;
        for (size_t i = 0; i < 3; ++i)
            p[i] = (glm::dvec2(corners[i][u_], corners[i][v_]) - low_) / step_ - kOffset;
        const glm::dvec2 first = glm::ceil(glm::min(glm::min(p[0], p[1]), p[2]));
        const glm::dvec2 last = glm::floor(glm::max(glm::max(p[0], p[1]), p[2]));
        const glm::dvec3 size = glm::abs(normal);
        const Crossing crossing{0, 0, 0, normal[axis_] / length,
                                size[axis_] >= size[u_] && size[axis_] >= size[v_]};
        for (double y = std::max(first.y, 0.0); y <= std::min(last.y, kLines - 1.0); ++y)
            for (double x = std::max(first.x, 0.0); x <= std::min(last.x, kLines - 1.0); ++x)
                cross(corners, p, {x, y}, crossing);
    }

    /// True if there are too many crossings to tell anything.
    bool is_full() const { return crossings_.size() >= kMaxCrossings; }

    void add_chords(std::vector<Chord>& chords) {
        const double square = step_.x * step_.y;
        std::ranges::sort(crossings_, {}, [](const Crossing& crossing) {
            return std::tuple(crossing.line, crossing.at, crossing.number);
        });
        for (size_t i = 0; i < crossings_.size();) {
            const size_t line = crossings_[i].line;
            int depth = 0;
            const Crossing* entry = nullptr;
            for (; i < crossings_.size() && crossings_[i].line == line; ++i) {
                const Crossing& crossing = crossings_[i];
                if (crossing.normal < 0 && depth++ == 0) entry = &crossing;
                if (crossing.normal > 0 && --depth == 0 && entry && entry->turns_here)
                    chords.push_back(
                        {(crossing.at - entry->at) * -entry->normal, square / -entry->normal});
            }
        }
    }

  private:
    void cross(const std::array<glm::dvec3, 3>& corners, const std::array<glm::dvec2, 3>& p,
               const glm::dvec2& line, Crossing crossing) {
        const auto area = [](const glm::dvec2& a, const glm::dvec2& b) {
            return a.x * b.y - a.y * b.x;
        };
        const std::array<glm::dvec2, 3> q = {p[0] - line, p[1] - line, p[2] - line};
        const glm::dvec3 weights(area(q[1], q[2]), area(q[2], q[0]), area(q[0], q[1]));
        const double sum = weights.x + weights.y + weights.z;
        if (sum == 0 || weights.x * sum < 0 || weights.y * sum < 0 || weights.z * sum < 0) return;
        for (int i = 0; i < 3; ++i) crossing.at += weights[i] / sum * corners[size_t(i)][axis_];
        crossing.line = size_t(line.x) + kLines * size_t(line.y);
        crossing.number = crossings_.size();
        crossings_.push_back(crossing);
    }

    int axis_, u_, v_;
    glm::dvec2 low_, step_;
    std::vector<Crossing> crossings_;
};

/// The thickness that `share` of the area doesn't reach, of chords in ascending order.
double quantile(const std::vector<Chord>& chords, double share) {
    double sum = 0;
    for (const Chord& chord : chords) sum += chord.area;
    double so_far = 0;
    for (const Chord& chord : chords) {
        so_far += chord.area;
        if (so_far >= share * sum) return chord.thickness;
    }
    return 0;
}

}  // namespace

MeshThickness thickness_of(const Mesh& mesh) {
    const Bounds box = mesh_bounds(mesh);
    const Places places(mesh, box);
    std::vector<Chord> chords;
    for (int axis = 0; axis < 3; ++axis) {
        AxisLines lines(box, axis);
        for (const glm::uvec3& t : mesh.triangles) {
            if (!places.may_cross(t, (axis + 1) % 3) || !places.may_cross(t, (axis + 2) % 3))
                continue;
            lines.cross({glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                         glm::dvec3(mesh.positions[t.z])});
        }
        if (lines.is_full()) return {};
        lines.add_chords(chords);
    }
    std::ranges::stable_sort(chords, {}, &Chord::thickness);
    return {quantile(chords, kThinShare), quantile(chords, kThinPartShare)};
}

}  // namespace voxelume
