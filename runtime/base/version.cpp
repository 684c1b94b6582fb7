// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/version.hpp"

namespace voxelume {

const char* version() {
    return VXL_VERSION;
}

}  // namespace voxelume
