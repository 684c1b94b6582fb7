// SPDX-License-Identifier: Apache-2.0
// Alias tables against the weights that they are made of.
#include "runtime/stages/light/tables/alias_table.hpp"

#include <gmock/gmock.h>

#include <random>

namespace voxelume {
namespace {

/// The probabilities with which the slots choose each number.
std::vector<double> chances_of(const std::vector<AliasSlot>& slots) {
    std::vector<double> chances(slots.size());
    for (size_t i = 0; i < slots.size(); ++i) {
        chances[i] += slots[i].own_share / double(slots.size());
        chances[slots[i].alias] += (1 - slots[i].own_share) / double(slots.size());
    }
    return chances;
}

TEST(AliasTable, ChoosesByWeight) {
    // Computed by hand for weights 1, 3 and 8 in slots of 4 each.
    const std::vector<double> weights = {1, 3, 8};
    const std::vector<double> chances = chances_of(alias_table(weights));
    EXPECT_NEAR(chances[0], 1.0 / 12, 1e-15);
    EXPECT_NEAR(chances[1], 3.0 / 12, 1e-15);
    EXPECT_NEAR(chances[2], 8.0 / 12, 1e-15);
}

TEST(AliasTable, NeverChoosesWhatHasNoWeight) {
    const std::vector<double> weights = {0, 5, 0, 0, 2};
    const std::vector<AliasSlot> slots = alias_table(weights);
    for (const size_t i : {0, 2, 3}) {
        EXPECT_EQ(slots[i].own_share, 0) << i;
        EXPECT_GT(weights[slots[i].alias], 0) << i;
    }
    EXPECT_EQ(alias_table(std::vector<double>{7})[0].own_share, 1);
}

TEST(AliasTable, IsExactForWeightsOfAnySize) {
    std::mt19937 random(5);
    std::vector<double> weights;
    double sum = 0;
    for (int i = 0; i < 10'000; ++i) {
        weights.push_back(std::exp2(std::uniform_real_distribution(-30.0, 30.0)(random)));
        sum += weights.back();
    }
    const std::vector<AliasSlot> slots = alias_table(weights);
    const std::vector<double> chances = chances_of(slots);
    for (size_t i = 0; i < weights.size(); ++i) {
        ASSERT_NEAR(chances[i], weights[i] / sum, 1e-14 + 1e-9 * weights[i] / sum) << i;
        ASSERT_GE(slots[i].own_share, 0) << i;
        ASSERT_LE(slots[i].own_share, 1) << i;
    }
}

}  // namespace
}  // namespace voxelume
