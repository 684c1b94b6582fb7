// SPDX-License-Identifier: Apache-2.0
// Cuts polygons as fans or by their ears. Decisions use the signs of areas in double. They choose
// between triangulations that are all valid meshes, so a wrong sign does no more than place a
// diagonal badly.
#include "runtime/io/mesh/mesh_polygon.hpp"

#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include <utility>

namespace voxelume {
namespace {

/// Twice the area of a b c: positive when they run counter-clockwise.
double area2(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x);
}

glm::dvec3 newell_normal(std::span<const uint32_t> corners, const Mesh& mesh) {
    glm::dvec3 normal(0.0);
    const glm::dvec3 origin(mesh.positions[corners[0]]);
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
        normal += glm::cross(glm::dvec3(mesh.positions[corners[i]]) - origin,
                             glm::dvec3(mesh.positions[corners[i + 1]]) - origin);
    }
    return normal;
}

}  // namespace

void require_triangle_count(const MeshSource& source, uint64_t count) {
    if (count > kMaxTriangles) {
        throw Error(
            ErrorKind::limit,
            "{}: a mesh has at most {} triangles (2^31 indices) here, and this one has more; "
            "split it into several models",
            source.name, kMaxTriangles);
    }
}

void PolygonCutter::append(const MeshSource& source, std::span<const uint32_t> corners, Mesh& mesh,
                           std::span<const uint32_t> normals) {
    require_triangle_count(source, mesh.triangles.size() + corners.size() - 2);
    cut(source, corners, mesh);
    for (const glm::uvec3& t : cut_)
        mesh.triangles.emplace_back(corners[t.x], corners[t.y], corners[t.z]);
    if (normals.empty()) return;
    for (const glm::uvec3& t : cut_)
        mesh.triangle_normals.emplace_back(normals[t.x], normals[t.y], normals[t.z]);
}

/// Cuts the polygon into triangles, as indices of its corners.
void PolygonCutter::cut(const MeshSource& source, std::span<const uint32_t> corners,
                        const Mesh& mesh) {
    cut_.clear();
    if (corners.size() > 3) {
        project(corners, mesh);
        if (!fan_covers()) {
            if (corners.size() > kMaxConcaveCorners) {
                throw Error(ErrorKind::limit,
                            "{}: a concave face with {} corners; cut faces of more than {} corners "
                            "into triangles in the program that wrote them",
                            source.name, corners.size(), kMaxConcaveCorners);
            }
            cut_ears(corners.size());
            return;
        }
    }
    for (size_t i = 1; i + 1 < corners.size(); ++i) {
        cut_.emplace_back(0, i, i + 1);
    }
}

void PolygonCutter::project(std::span<const uint32_t> corners, const Mesh& mesh) {
    const glm::dvec3 normal = newell_normal(corners, mesh);
    const glm::dvec3 size = glm::abs(normal);
    const int dropped = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    int u = (dropped + 1) % 3;
    int v = (dropped + 2) % 3;
    if (normal[dropped] < 0.0) {
        std::swap(u, v);
    }
    flat_.clear();
    for (const uint32_t corner : corners) {
        flat_.emplace_back(mesh.positions[corner][u], mesh.positions[corner][v]);
    }
}

/// True if no triangle of the fan is negative. The signed areas of a fan always add up to the
/// polygon's. If none is negative, no triangle overlaps another, and the fan covers a simple
/// polygon exactly, convex or not.
bool PolygonCutter::fan_covers() const {
    for (size_t i = 1; i + 1 < flat_.size(); ++i) {
        if (area2(flat_[0], flat_[i], flat_[i + 1]) < 0.0) {
            return false;
        }
    }
    return true;
}

double PolygonCutter::turn(size_t corner) const {
    return area2(flat_[before_[corner]], flat_[corner], flat_[after_[corner]]);
}

/// True if the corner turns left, and no corner that doesn't turn left lies in or on its triangle.
/// Corners at the positions of the triangle's own three don't count: exporters join holes to the
/// outline with such duplicates.
bool PolygonCutter::is_ear(size_t corner) const {
    const glm::dvec2& a = flat_[before_[corner]];
    const glm::dvec2& b = flat_[corner];
    const glm::dvec2& c = flat_[after_[corner]];
    if (!(area2(a, b, c) > 0.0)) {
        return false;
    }
    for (size_t i = after_[after_[corner]]; i != before_[corner]; i = after_[i]) {
        const glm::dvec2& p = flat_[i];
        const bool inside = area2(a, b, p) >= 0.0 && area2(b, c, p) >= 0.0 && area2(c, a, p) >= 0.0;
        if (inside && p != a && p != b && p != c && turn(i) <= 0.0) {
            return false;
        }
    }
    return true;
}

void PolygonCutter::cut_ears(size_t count) {
    before_.resize(count);
    after_.resize(count);
    ear_.resize(count);
    for (size_t i = 0; i < count; ++i) {
        before_[i] = (i + count - 1) % count;
        after_[i] = (i + 1) % count;
    }
    for (size_t i = 0; i < count; ++i) {
        ear_[i] = is_ear(i);
    }
    size_t corner = 0;
    for (size_t left = count; left > 3; --left) {
        size_t tries = 0;
        for (; tries < left && !ear_[corner]; ++tries) {
            corner = after_[corner];
        }
        // A polygon that crosses itself may have no ear. Then any corner that turns left is taken.
        for (; tries >= left && tries < 2 * left && !(turn(corner) > 0.0); ++tries) {
            corner = after_[corner];
        }
        const size_t previous = before_[corner];
        const size_t next = after_[corner];
        cut_.emplace_back(previous, corner, next);
        after_[previous] = next;
        before_[next] = previous;
        ear_[previous] = is_ear(previous);
        ear_[next] = is_ear(next);
        // Skipping the neighbour cuts a strip of ears instead of a fan of slivers.
        corner = after_[next];
    }
    cut_.emplace_back(before_[corner], corner, after_[corner]);
}

}  // namespace voxelume
