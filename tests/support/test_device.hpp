// SPDX-License-Identifier: Apache-2.0
// The device that the tests run on.
#pragma once

#include <gtest/gtest.h>

#include <cstdint>
#include <cstdlib>
#include <string>
#include <utility>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/opencl/device.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {

/// A device on which nothing runs, open until the tests end. All devices opened meanwhile share the
/// compiler's cost of a context. It also stays open if the process ends within a test, because the
/// driver ends before static variables do.
class OpenContext : public ::testing::Environment {
  public:
    void TearDown() override { delete std::exchange(device, nullptr); }
    inline static const Device* device = nullptr;
};

inline ::testing::Environment* const kOpenContext =
    ::testing::AddGlobalTestEnvironment(new OpenContext);

/// The device named by VXL_TEST_DEVICE, else the first CPU. If `lanes` is 0, uses VXL_TEST_LANES or
/// the device's own number.
inline Device test_device(int lanes = 0) {
    const char* name = std::getenv("VXL_TEST_DEVICE");
    const char* lanes_text = std::getenv("VXL_TEST_LANES");
    if (lanes == 0 && lanes_text) lanes = std::atoi(lanes_text);
    if (!name) name = "cpu";
    if (!OpenContext::device) OpenContext::device = new Device(Device::open(name));
    return Device::open(name, lanes, OpenContext::device);
}

/// The tests' device, limited to this much memory.
inline Device device_with_memory(uint64_t megabytes) {
    setenv("VOXELUME_MEMORY_MB", std::to_string(megabytes).c_str(), 1);
    Device device = test_device();
    unsetenv("VOXELUME_MEMORY_MB");
    return device;
}

/// All numbers of lanes in an exhaustive run, otherwise only the device's own: each number makes
/// kernels compile again.
inline std::vector<int> lanes_with_all() {
    if (is_exhaustive()) return {1, 4, 8, 16};
    return {test_device().lanes()};
}

}  // namespace voxelume
