// SPDX-License-Identifier: Apache-2.0
// weights -> a table that chooses each number in proportion to its weight, with one lookup.
#pragma once

#include <cstdint>
#include <span>
#include <vector>

namespace voxelume {

/// One of equally probable slots: number i itself with this share, otherwise another number.
struct AliasSlot {
    double own_share = 1;
    uint32_t alias = 0;
};

/// The slots for weights of at least 0, not all of them 0. Walker 1974, made as Vose 1991 does.
std::vector<AliasSlot> alias_table(std::span<const double> weights);

}  // namespace voxelume
