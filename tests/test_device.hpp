// The device that the tests run on.
#pragma once

#include <cstdlib>

#include "runtime/error.hpp"
#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The device named by VXL_TEST_DEVICE, else the first CPU; `lanes` 0 takes VXL_TEST_LANES or its
/// own.
inline Device test_device(int lanes = 0) {
    const char* name = std::getenv("VXL_TEST_DEVICE");
    const char* lanes_text = std::getenv("VXL_TEST_LANES");
    if (lanes == 0 && lanes_text) lanes = std::atoi(lanes_text);
    return Device::open(name ? name : "cpu", lanes);
}

}  // namespace voxelume
