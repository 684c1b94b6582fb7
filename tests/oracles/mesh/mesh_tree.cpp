// SPDX-License-Identifier: Apache-2.0
#include "tests/oracles/mesh/mesh_tree.hpp"

#include <algorithm>
#include <limits>
#include <numeric>
#include <utility>

namespace voxelume::oracle {

MeshTree::MeshTree(std::vector<Triangle> triangles)
    : triangles_(std::move(triangles)), order_(triangles_.size()) {
    std::iota(order_.begin(), order_.end(), 0u);
    nodes_.emplace_back();
    split(0, 0, static_cast<uint32_t>(order_.size()));
}

void MeshTree::split(uint32_t node, uint32_t first, uint32_t count) {
    glm::dvec3 low(std::numeric_limits<double>::infinity()), high(-low);
    for (uint32_t i = first; i < first + count; ++i) {
        for (const glm::dvec3& corner : triangles_[order_[i]]) {
            low = glm::min(low, corner);
            high = glm::max(high, corner);
        }
    }
    nodes_[node] = {low, high, first, count};
    if (count <= 4) return;
    const glm::dvec3 size = high - low;
    const int axis = size.x >= size.y && size.x >= size.z ? 0 : size.y >= size.z ? 1 : 2;
    const auto middle = [&](uint32_t number) {
        const Triangle& t = triangles_[number];
        return t[0][axis] + t[1][axis] + t[2][axis];
    };
    const uint32_t half = count / 2;
    std::nth_element(order_.begin() + first, order_.begin() + first + half,
                     order_.begin() + first + count,
                     [&](uint32_t a, uint32_t b) { return middle(a) < middle(b); });
    const auto child = static_cast<uint32_t>(nodes_.size());
    nodes_.resize(nodes_.size() + 2);
    nodes_[node].first = child;
    nodes_[node].count = 0;
    split(child, first, half);
    split(child + 1, first + half, count - half);
}

}  // namespace voxelume::oracle
