// SPDX-License-Identifier: Apache-2.0
// Polygon -> triangles, for the mesh formats whose faces may have any number of corners.
#pragma once

#include "runtime/geometry/mesh.hpp"
#include "runtime/io/mesh/mesh_source.hpp"

#include <glm/vec2.hpp>

#include <cstdint>
#include <span>
#include <vector>

namespace voxelume {

/// The maximum number of triangles: a mesh has at most 2^31 indices, so that kernels count them in
/// an int.
constexpr uint64_t kMaxTriangles = (uint64_t{1} << 31) / 3;

/// The maximum number of corners of a face that the fan from its first corner doesn't cover.
/// Cutting ears takes time proportional to the square of this number (0.3 s for one face at the
/// limit).
constexpr size_t kMaxConcaveCorners = 16384;

/// Throws Error::limit when a mesh would have more than `kMaxTriangles`.
void require_triangle_count(const MeshSource& source, uint64_t count);

/// Cuts polygons into triangles. It keeps its scratch memory from one polygon to the next.
///
/// A polygon of n corners always gives n - 2 triangles that use every corner, in the polygon's
/// sense of rotation. The fan from the first corner is taken when it covers the polygon exactly
/// (always for a convex one); otherwise ears are cut off (Meisters 1975; status kept as in Eberly,
/// "Triangulation by Ear Clipping"). A polygon that isn't flat is judged in its projection along
/// the largest component of its normal. A polygon that crosses itself, or has no area, still gives
/// n - 2 triangles.
class PolygonCutter {
  public:
    /// Appends the triangles of `corners` (at least three, all below `mesh.positions.size()`), and
    /// to `mesh.triangle_normals` those of `normals`, one per corner, if there are some. Throws
    /// Error::limit beyond `kMaxTriangles` or `kMaxConcaveCorners`.
    void append(const MeshSource& source, std::span<const uint32_t> corners, Mesh& mesh,
                std::span<const uint32_t> normals = {});

    /// The triangles of the last polygon, as indices of its corners.
    const std::vector<glm::uvec3>& triangles() const { return cut_; }

  private:
    void cut(const MeshSource& source, std::span<const uint32_t> corners, const Mesh& mesh);
    void project(std::span<const uint32_t> corners, const Mesh& mesh);
    bool fan_covers() const;
    void cut_ears(size_t count);
    double turn(size_t corner) const;
    bool is_ear(size_t corner) const;

    std::vector<glm::uvec3> cut_;   ///< triangles, as indices of the polygon's corners
    std::vector<glm::dvec2> flat_;  ///< the corners, projected so that they run counter-clockwise
    std::vector<size_t> before_;    ///< the corner before each in the ring of those that remain
    std::vector<size_t> after_;
    std::vector<char> ear_;
};

}  // namespace voxelume
