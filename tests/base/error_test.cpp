// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/error.hpp"

#include <gtest/gtest.h>

namespace voxelume {

TEST(Error, AKindIsItsExitCode) {
    EXPECT_EQ(Error(ErrorKind::scene, "room.json:12:9: no material").exit_code(), 3);
    EXPECT_EQ(Error(ErrorKind::limit, "too large").exit_code(), 8);
}

TEST(Error, FormatsItsSentence) {
    EXPECT_STREQ(Error(ErrorKind::limit, "needs {} GB", 9).what(), "needs 9 GB");
}

}  // namespace voxelume
