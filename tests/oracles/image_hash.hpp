// SPDX-License-Identifier: Apache-2.0
// A hash that changes if any bit of an image changes.
#pragma once

#include <cstdint>

#include "runtime/image/image.hpp"

namespace voxelume::oracle {

/// FNV-1a over the size and every plane's name and bits, in the order of names.
uint64_t image_hash(const voxelume::Image& image);

}  // namespace voxelume::oracle
