// SPDX-License-Identifier: Apache-2.0
// Parts that tests of the library's functions share: the options of their process.
//
// Tests live in the namespace of the header's names, because their programs also know the inner
// names.
#pragma once

#ifndef VOXELUME_BUILDING
#define VOXELUME_BUILDING
#endif

#include <gtest/gtest.h>

#include <cstdlib>
#include <string>

#include "runtime/voxelume.hpp"

namespace voxelume::v1 {

/// Lets compiled kernels come from the cache that all tests share.
class ProcessEnvironment : public ::testing::Environment {
  public:
    void SetUp() override { configure({.set_driver_environment = true}); }
};

inline ::testing::Environment* const kProcessEnvironment =
    ::testing::AddGlobalTestEnvironment(new ProcessEnvironment);

/// The selector of the device that the tests run on.
inline std::string test_selector() {
    const char* name = std::getenv("VXL_TEST_DEVICE");
    return name ? name : "cpu";
}

}  // namespace voxelume::v1
