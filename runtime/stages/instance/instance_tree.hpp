// SPDX-License-Identifier: Apache-2.0
// boxes of instances -> the tree that packets of rays traverse: kernels/lib/packets/instances.h.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernels/shared/instance.h"

namespace voxelume {

/// A box in the world, in the world's voxels.
struct InstanceBox {
    glm::dvec3 low{0}, high{0};
};

/// The tree whose leaves are the boxes, numbered as in `boxes`. It is at most VXL_INSTANCE_DEPTH
/// deep.
///
/// Boxes are divided into halves of equal number along the axis on which their middles are farthest
/// apart; equal middles stay in the order of `boxes`. The stored boxes are `margin` voxels larger
/// than those given, and rounded outwards. Without boxes the tree is empty.
std::vector<InstanceNode> build_instance_tree(std::span<const InstanceBox> boxes, double margin);

}  // namespace voxelume
