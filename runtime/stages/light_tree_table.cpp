// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light_tree_table.hpp"

namespace voxelume {

void bind(KernelArguments& to, const LightTree& tree) {
    to.add(tree.lights, tree.areas, tree.nodes, tree.levels, tree.compared,
           uint32_t(tree.has_areas));
}

}  // namespace voxelume
