// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light_tree_table.hpp"

namespace voxelume {

void bind(KernelArguments& to, const LightTree& tree) {
    to.add(tree.lights, tree.nodes, tree.levels, tree.compared);
}

}  // namespace voxelume
