// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/tables/alias_table.hpp"

namespace voxelume {

std::vector<AliasSlot> alias_table(std::span<const double> weights) {
    double sum = 0;
    for (const double weight : weights) sum += weight;
    std::vector<AliasSlot> slots(weights.size());
    std::vector<double> left;  // remaining weight of each number, in slots
    std::vector<uint32_t> poor, rich;
    left.reserve(weights.size());
    for (uint32_t i = 0; i < weights.size(); ++i) {
        left.push_back(weights[i] / sum * double(weights.size()));
        slots[i].alias = i;
        (left[i] < 1 ? poor : rich).push_back(i);
    }
    // A poor number gives the rest of its slot to a rich one, which may become poor by that.
    while (!poor.empty() && !rich.empty()) {
        const uint32_t low = poor.back(), high = rich.back();
        poor.pop_back();
        slots[low] = {left[low], high};
        left[high] -= 1 - left[low];
        if (left[high] >= 1) continue;
        rich.pop_back();
        poor.push_back(high);
    }
    return slots;
}

}  // namespace voxelume
