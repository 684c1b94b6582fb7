// SPDX-License-Identifier: Apache-2.0
// OpenCL's status codes in words.
#pragma once

#include <string>

namespace voxelume {

/// "CL_OUT_OF_RESOURCES (-5)"; "status -9999" for a code that OpenCL doesn't define.
std::string status_name(int status);

/// True if the code means that the device's or the host's memory doesn't suffice.
bool is_out_of_memory(int status);

}  // namespace voxelume
