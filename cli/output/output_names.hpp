// SPDX-License-Identifier: Apache-2.0
// `out/{name}.png`: outputs of several inputs, views and values in one call.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace voxelume::cli {

/// The texts that placeholders stand for, by their names without braces.
using Placeholders = std::vector<std::pair<std::string, std::string>>;

/// Puts texts in the places of `{name}`. Throws Error::usage with the nearest name for a
/// placeholder that there isn't; `command` opens the message.
std::string fill_in(const std::string& pattern, const Placeholders& placeholders,
                    const char* command);

/// A number with as many digits as the largest one has: "03" of 12.
std::string padded(size_t number, size_t largest);

}  // namespace voxelume::cli
