// SPDX-License-Identifier: Apache-2.0
// Smaller tests for devices that interpret kernels.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace voxelume {

/// The number of rays, terms or pixels: `full`, or `few` on oclgrind, which takes about a thousand
/// times as long because it checks each access to memory. Other runs test how exact kernels are.
inline uint32_t full_or(uint32_t few, uint32_t full) {
    const char* name = std::getenv("VXL_TEST_DEVICE");
    return name && std::string_view(name) == "oclgrind" ? few : full;
}

}  // namespace voxelume
