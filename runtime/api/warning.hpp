// SPDX-License-Identifier: Apache-2.0
// Warnings of the library's inside -> warnings for callers.
#pragma once

#include <span>
#include <vector>

#include "runtime/base/warning.hpp"
#include "runtime/voxelume/warning.hpp"

namespace voxelume::api {

std::vector<v1::Warning> warnings_for_callers(std::span<const Warning> warnings);

}  // namespace voxelume::api
