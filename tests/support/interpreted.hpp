// Smaller tests where the device interprets kernels.
#pragma once

#include <cstdint>
#include <cstdlib>
#include <string_view>

namespace voxelume {

/// How many rays, terms or pixels: `full`, or `few` on oclgrind, which takes some thousand times as
/// long for each access to memory that it checks. How exact kernels are shows elsewhere.
inline uint32_t full_or(uint32_t few, uint32_t full) {
    const char* name = std::getenv("VXL_TEST_DEVICE");
    return name && std::string_view(name) == "oclgrind" ? few : full;
}

}  // namespace voxelume
