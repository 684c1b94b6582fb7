// SPDX-License-Identifier: Apache-2.0
// A tree of boxes over triangles in double precision, for the oracles that search a mesh.
#pragma once

#include <array>
#include <cstdint>
#include <glm/glm.hpp>
#include <vector>

namespace voxelume::oracle {

using Triangle = std::array<glm::dvec3, 3>;

/// A tree that halves triangles at the median of the longest axis until four or fewer are left.
class MeshTree {
  public:
    struct Node {
        glm::dvec3 low, high;
        uint32_t first = 0;  ///< leaf: index of its first triangle in `order`; else index of the
                             ///< first of its two children
        uint32_t count = 0;  ///< triangles of a leaf, 0 for a node with children
    };

    explicit MeshTree(std::vector<Triangle> triangles);

    const std::vector<Triangle>& triangles() const { return triangles_; }
    const std::vector<Node>& nodes() const { return nodes_; }  ///< the root first
    const std::vector<uint32_t>& order() const { return order_; }

  private:
    void split(uint32_t node, uint32_t first, uint32_t count);

    std::vector<Triangle> triangles_;
    std::vector<uint32_t> order_;
    std::vector<Node> nodes_;
};

}  // namespace voxelume::oracle
