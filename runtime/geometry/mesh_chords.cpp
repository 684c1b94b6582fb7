// SPDX-License-Identifier: Apache-2.0
#include "runtime/geometry/mesh_chords.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <glm/common.hpp>
#include <glm/ext/vector_int3_sized.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <tuple>
#include <vector>

#include "runtime/geometry/mesh_summary.hpp"

namespace voxelume {
namespace {

/// Rows of lines that are looked at together, so that their crossings take little memory.
constexpr int kRows = 64;

/// The maximum number of crossings on these rows: 1,024 for each line of a lattice of 64 x 64, 16
/// for each where a row has 4,096. A mesh with more layers has no inside.
constexpr size_t kMaxCrossings = size_t{1} << 22;

/// The position of a line in its square, off the middle: few meshes have edges there.
constexpr double kOffset = 0.4142135623730950;

/// The positions of a mesh's vertices relative to the lines along each axis: twice a line's number
/// for vertices on it, one more for those behind it. Most triangles of large meshes lie between the
/// same lines.
class LinePositions {
  public:
    LinePositions(const Mesh& mesh, const Bounds& box, const glm::ivec3& lines) {
        const glm::dvec3 step =
            glm::max((box.max - box.min) / glm::dvec3(lines), std::numeric_limits<double>::min());
        positions_.reserve(mesh.positions.size());
        glm::i16vec3 relative;
        for (const glm::vec3& position : mesh.positions) {
            const glm::dvec3 p = (glm::dvec3(position) - box.min) / step - kOffset;
            const glm::ivec3 whole(p);
            for (int axis = 0; axis < 3; ++axis)
                relative[axis] =
                    int16_t(2 * whole[axis] + (p[axis] > whole[axis]) - (p[axis] < whole[axis]));
            positions_.push_back(relative);
        }
    }

    /// True if some line of those that lie side by side along `axis`, from number `first` to before
    /// `end`, may cross the triangle.
    bool may_cross(const glm::uvec3& t, int axis, int first, int end) const {
        const auto [low, high] =
            std::minmax({positions_[t.x][axis], positions_[t.y][axis], positions_[t.z][axis]});
        return (low < high || low % 2 == 0) && high >= 2 * first && low <= 2 * end;
    }

  private:
    std::vector<glm::i16vec3> positions_;
};

struct Crossing {
    size_t line = 0;
    size_t number = 0;        ///< in the order of the triangles
    double at = 0;            ///< along the axis
    double normal = 0;        ///< the face's normal along the axis, 1 if it looks forwards
    bool turns_here = false;  ///< its normal is more along this axis than along the others
    glm::vec3 face{0};        ///< its normal
};

/// Two faces look away from each other if the cosine between their normals is below this.
constexpr float kAway = -0.5f;

/// Two faces are the sides of a sheet if the cosine is below this: a wedge has more than 6 degrees.
constexpr float kSheet = -0.995f;

/// Some rows of the lines along one axis.
class AxisLines {
  public:
    AxisLines(const Bounds& box, const glm::ivec3& lines, int axis, int first_row)
        : axis_(axis),
          u_((axis + 1) % 3),
          v_((axis + 2) % 3),
          first_(first_row),
          last_(std::min(first_row + kRows, lines[v_]) - 1),
          columns_(lines[u_]) {
        low_ = {box.min[u_], box.min[v_]};
        step_ = glm::dvec2(box.max[u_] - low_.x, box.max[v_] - low_.y) /
                glm::dvec2(columns_, lines[v_]);
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
        const Crossing crossing{0,
                                0,
                                0,
                                normal[axis_] / length,
                                size[axis_] >= size[u_] && size[axis_] >= size[v_],
                                glm::vec3(normal / length)};
        for (double y = std::max(first.y, first_); y <= std::min(last.y, last_); ++y)
            for (double x = std::max(first.x, 0.0); x <= std::min(last.x, columns_ - 1.0); ++x)
                cross(corners, p, {x, y}, crossing);
    }

    /// True if there are too many crossings to tell anything.
    bool is_full() const { return crossings_.size() >= kMaxCrossings; }

    void give_chords(const std::function<void(const Chord&)>& add) {
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
                if (crossing.normal > 0 && --depth == 0 && entry && entry->turns_here) {
                    const float cosine = glm::dot(entry->face, crossing.face);
                    add({at(*entry), at(crossing), (crossing.at - entry->at) * -entry->normal,
                         square / -entry->normal, cosine < kAway, cosine < kSheet});
                }
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
        crossing.line = size_t(line.x) + size_t(columns_) * size_t(line.y);
        crossing.number = crossings_.size();
        crossings_.push_back(crossing);
    }

    glm::dvec3 at(const Crossing& crossing) const {
        const auto columns = size_t(columns_);
        const size_t column = crossing.line % columns, row = crossing.line / columns;
        glm::dvec3 p;
        p[axis_] = crossing.at;
        p[u_] = low_.x + (double(column) + kOffset) * step_.x;
        p[v_] = low_.y + (double(row) + kOffset) * step_.y;
        return p;
    }

    int axis_, u_, v_;
    double first_, last_;  ///< rows
    double columns_;
    glm::dvec2 low_, step_;
    std::vector<Crossing> crossings_;
};

}  // namespace

bool for_each_chord(const Mesh& mesh, const glm::ivec3& lines,
                    const std::function<void(const Chord&)>& add) {
    const Bounds box = mesh_bounds(mesh);
    const LinePositions positions(mesh, box, lines);
    for (int axis = 0; axis < 3; ++axis)
        for (int row = 0; row < lines[(axis + 2) % 3]; row += kRows) {
            AxisLines some(box, lines, axis, row);
            for (const glm::uvec3& t : mesh.triangles) {
                if (!positions.may_cross(t, (axis + 2) % 3, row, row + kRows) ||
                    !positions.may_cross(t, (axis + 1) % 3, 0, lines[(axis + 1) % 3]))
                    continue;
                some.cross({glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                            glm::dvec3(mesh.positions[t.z])});
            }
            if (some.is_full()) return false;
            some.give_chords(add);
        }
    return true;
}

}  // namespace voxelume
