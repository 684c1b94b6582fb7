// SPDX-License-Identifier: Apache-2.0
// The view transforms of pictures, as --view-transform names them.
#pragma once

#include <string>
#include <string_view>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// Reads the name of a view transform. Throws Error::usage, suggesting the nearest name; `origin`
/// opens the message.
ViewTransform parse_view_transform(const std::string& text, const char* origin);

/// The name that parse_view_transform reads.
std::string_view name_of(ViewTransform transform);

}  // namespace voxelume::cli
