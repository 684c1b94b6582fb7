// SPDX-License-Identifier: Apache-2.0
// The channels of images, as --channels names them.
#pragma once

#include <string>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// Reads "RGBA,Z". Throws Error::usage; `origin` opens the message.
Channels parse_channels(const std::string& text, const char* origin);

/// The names of the channels, in the form that parse_channels reads.
std::string channel_names(const Channels& channels);

}  // namespace voxelume::cli
