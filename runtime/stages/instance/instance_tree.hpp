// The boxes of instances as the tree that packets of rays go through:
// kernels/lib/traverse/instances.h.
#pragma once

#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "kernels/shared/instance.h"

namespace voxelume {

/// A box in the world, in its voxels.
struct InstanceBox {
    glm::dvec3 low{0}, high{0};
};

/// A tree whose leaves are the boxes, numbered as in `boxes`, at most VXL_INSTANCE_DEPTH deep.
///
/// Boxes are halved by number along the axis on which their middles lie farthest apart; equal
/// middles stay in the order of `boxes`. Stored boxes are `margin` voxels larger than those given,
/// and rounded outwards. None for no boxes.
std::vector<InstanceNode> build_instance_tree(std::span<const InstanceBox> boxes, double margin);

}  // namespace voxelume
