// SPDX-License-Identifier: Apache-2.0
// mesh -> its edges, and what lies across them.
#pragma once

#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// An edge as two sides of triangles, whose faces meet there. A side's number is 3 times that of
/// its triangle plus that of the corner at which it begins.
struct MeshEdge {
    uint32_t a = 0, b = 0;
    bool is_fork = false;  ///< more than two faces meet, of which these are two
};

/// The side after this one in its triangle.
inline uint32_t next_side(uint32_t side) {
    return side % 3 == 2 ? side - 2 : side + 1;
}

/// The edges of a mesh at which two faces or more meet, in the order of their ends. Vertices at one
/// position are one; sides without length and faces without area have no edges. Faces of several
/// bodies that lie in one another and look to the same side count as one, as where parts of a mesh
/// overlap with equal corners.
class MeshEdges {
  public:
    explicit MeshEdges(const Mesh& mesh);

    const std::vector<MeshEdge>& edges() const { return edges_; }

    /// The unit normal of the triangle of a side; 0 if it has no area.
    const glm::dvec3& normal(uint32_t side) const { return normals_[side / 3]; }

    /// The side that lies across a side, kNoSide at rims and forks.
    uint32_t across(uint32_t side) const { return across_[side]; }

    /// The index of the first position that is equal to the one at which a side begins.
    uint32_t begin(uint32_t side) const {
        return first_equal_[mesh_.triangles[side / 3][int(side % 3)]];
    }
    glm::dvec3 position(uint32_t number) const { return glm::dvec3(mesh_.positions[number]); }

    /// The position of the vertex at which a triangle's side starts.
    glm::dvec3 start(uint32_t side) const {
        return glm::dvec3(mesh_.positions[mesh_.triangles[side / 3][int(side % 3)]]);
    }

    /// -1 for two sides of one edge that run alike, so that their faces look to different sides of
    /// the surface; else 1.
    double sense(uint32_t a, uint32_t b) const { return begin(a) == begin(b) ? -1 : 1; }

    static constexpr uint32_t kNoSide = UINT32_MAX;

  private:
    const Mesh& mesh_;
    std::vector<uint32_t> first_equal_;  ///< for each position
    std::vector<glm::dvec3> normals_;
    std::vector<MeshEdge> edges_;
    std::vector<uint32_t> across_;
};

/// The turn of the surface at an edge, in degrees, 0..180; 0 where a face has no area.
double turn_at(const MeshEdges& edges, const MeshEdge& edge);

}  // namespace voxelume
