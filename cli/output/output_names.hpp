// SPDX-License-Identifier: Apache-2.0
// `out/{name}.png`: outputs of several inputs, views and values in one call.
#pragma once

#include <string>
#include <utility>
#include <vector>

namespace voxelume::cli {

/// The replacement texts of placeholders, by the placeholders' names without braces.
using Placeholders = std::vector<std::pair<std::string, std::string>>;

/// Replaces each `{name}` by its text. Throws Error::usage, suggesting the nearest name, for a
/// placeholder that doesn't exist; `command` opens the message.
std::string fill_in(const std::string& pattern, const Placeholders& placeholders,
                    const char* command);

/// A number with as many digits as the largest one: "03" for 3 of 12.
std::string padded(size_t number, size_t largest);

}  // namespace voxelume::cli
