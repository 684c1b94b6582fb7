// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/plane.hpp"

#include <gtest/gtest.h>

namespace voxelume {
namespace {

TEST(Plane, ACopyHasValuesOfItsOwn) {
    const Plane<float> first = {1, 2, 3};
    Plane<float> second = first;
    second[1] = 7;
    EXPECT_EQ(first, (Plane<float>{1, 2, 3}));
    EXPECT_EQ(second, (Plane<float>{1, 7, 3}));
    second = first;
    EXPECT_EQ(second, first);
}

TEST(Plane, KeepsThePieceOfMemoryThatItIsPartOf) {
    auto memory = std::make_shared<std::vector<int>>(std::vector<int>{1, 2, 3, 4, 5});
    const std::weak_ptr<std::vector<int>> watched = memory;
    Plane<int> part(std::shared_ptr<int>(memory, &(*memory)[2]), 2);
    memory.reset();
    EXPECT_EQ(part, (Plane<int>{3, 4}));
    const Plane<int> moved = std::move(part);
    EXPECT_EQ(moved, (Plane<int>{3, 4}));
    EXPECT_FALSE(watched.expired());
    part = {};
    EXPECT_FALSE(watched.expired());
}

TEST(Plane, HasNoValuesAtFirst) {
    EXPECT_TRUE(Plane<float>().empty());
    EXPECT_EQ(Plane<float>(), Plane<float>(std::vector<float>{}));
}

}  // namespace
}  // namespace voxelume
