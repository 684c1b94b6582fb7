// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/emitter_table.hpp"

namespace voxelume {

void bind(KernelArguments& to, const EmitterTable& emitters) {
    if (!emitters.is_searched) return;
    to.add(emitters.count, emitters.records, emitters.slots, emitters.table, emitters.frames,
           emitters.volume);
}

}  // namespace voxelume
