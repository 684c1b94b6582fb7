// SPDX-License-Identifier: Apache-2.0
// The points where rays meet a mesh, in double, and a subject of `voxelume bench` from a mesh file.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <optional>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/verify/bench/bench_subject.hpp"

namespace voxelume {

/// A tree of boxes over a mesh's triangles.
class MeshTruth {
  public:
    explicit MeshTruth(const Mesh& mesh, const glm::dmat4& world_from_mesh = glm::dmat4(1));

    /// The nearest triangle that the ray meets from either side, with its normal towards the ray. A
    /// ray on a common edge meets both triangles.
    std::optional<AnalyticHit> first_hit(const glm::dvec3& origin,
                                         const glm::dvec3& direction) const;

    /// The extent of a closed mesh whose triangles face outwards.
    Extent extent() const { return triangles_extent(corners_); }

  private:
    struct Node {
        glm::dvec3 low, high;
        uint32_t first = 0;  ///< first triangle of a leaf, else first of two children
        uint32_t count = 0;  ///< number of triangles of a leaf, 0 for a node with children
    };
    void split(uint32_t node, uint32_t first, uint32_t count);

    std::vector<glm::dvec3> corners_;  ///< three per triangle
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

inline constexpr const char* kBunnyFile = "/usr/share/glmark2/models/bunny.obj";

BenchSubject bunny_subject();

}  // namespace voxelume
