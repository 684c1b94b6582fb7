// SPDX-License-Identifier: Apache-2.0
// One device for all tests of a program, so that each kernel is prepared only once.
#pragma once

#include <gtest/gtest.h>

#include <optional>

#include "tests/support/test_device.hpp"

namespace voxelume {

/// Opens one device for all tests of a program and closes it before the driver's own end.
class SharedDevice : public ::testing::Environment {
  public:
    void SetUp() override { device = test_device(); }
    void TearDown() override { device.reset(); }
    inline static std::optional<Device> device;
};

inline ::testing::Environment* const kSharedDevice =
    ::testing::AddGlobalTestEnvironment(new SharedDevice);

/// The device of all tests: buffers of one device can't be read by kernels of another.
inline const Device& shared_device() {
    return SharedDevice::device.value();
}

}  // namespace voxelume
