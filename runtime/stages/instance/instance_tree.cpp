// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/instance/instance_tree.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <numeric>

namespace voxelume {
namespace {

/// A coordinate far from every world, which no ray reaches.
constexpr float kNowhere = 1e30f;

class TreeBuilder {
  public:
    TreeBuilder(std::span<const InstanceBox> boxes, double margin)
        : boxes_(boxes), margin_(margin) {
        middles_.reserve(boxes.size());
        for (const InstanceBox& box : boxes) middles_.push_back(box.low + box.high);
        order_.resize(boxes.size());
        std::iota(order_.begin(), order_.end(), 0u);
        nodes_.reserve(boxes.size());
    }

    std::vector<InstanceNode> run() {
        if (order_.empty()) return {};
        if (order_.size() == 1) {
            InstanceNode root{};
            for (float& value : root.low[1]) value = kNowhere;
            for (float& value : root.high[1]) value = kNowhere;
            root.child[0] = root.child[1] = VXL_INSTANCE_LEAF;
            store_box(root, 0, boxes_[0]);
            return {root};
        }
        build(order_);
        return std::move(nodes_);
    }

  private:
    /// Builds the tree of two instances or more. Returns its root's number.
    uint32_t build(std::span<uint32_t> numbers) {
        const auto node = static_cast<uint32_t>(nodes_.size());
        nodes_.emplace_back();
        const int axis = widest_axis(numbers);
        const size_t half = numbers.size() / 2;
        std::nth_element(numbers.begin(), numbers.begin() + ptrdiff_t(half), numbers.end(),
                         [&](uint32_t a, uint32_t b) {
                             return middles_[a][axis] != middles_[b][axis]
                                        ? middles_[a][axis] < middles_[b][axis]
                                        : a < b;
                         });
        add_child(node, 0, numbers.first(half));
        add_child(node, 1, numbers.subspan(half));
        return node;
    }

    void add_child(uint32_t node, int side, std::span<uint32_t> numbers) {
        InstanceBox box = boxes_[numbers[0]];
        for (const uint32_t number : numbers) {
            box.low = glm::min(box.low, boxes_[number].low);
            box.high = glm::max(box.high, boxes_[number].high);
        }
        store_box(nodes_[node], side, box);
        const uint32_t child =
            numbers.size() == 1 ? numbers[0] | VXL_INSTANCE_LEAF : build(numbers);
        nodes_[node].child[side] = child;
    }

    int widest_axis(std::span<const uint32_t> numbers) const {
        glm::dvec3 low = middles_[numbers[0]], high = low;
        for (const uint32_t number : numbers) {
            low = glm::min(low, middles_[number]);
            high = glm::max(high, middles_[number]);
        }
        const glm::dvec3 width = high - low;
        if (width.x >= width.y && width.x >= width.z) return 0;
        return width.y >= width.z ? 1 : 2;
    }

    void store_box(InstanceNode& node, int side, const InstanceBox& box) const {
        for (int axis = 0; axis < 3; ++axis) {
            node.low[side][axis] = std::nextafter(float(box.low[axis] - margin_), -INFINITY);
            node.high[side][axis] = std::nextafter(float(box.high[axis] + margin_), INFINITY);
        }
    }

    std::span<const InstanceBox> boxes_;
    double margin_;
    std::vector<glm::dvec3> middles_;  // twice the middle of each box
    std::vector<uint32_t> order_;
    std::vector<InstanceNode> nodes_;
};

}  // namespace

std::vector<InstanceNode> build_instance_tree(std::span<const InstanceBox> boxes, double margin) {
    return TreeBuilder(boxes, margin).run();
}

}  // namespace voxelume
