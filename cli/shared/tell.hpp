// SPDX-License-Identifier: Apache-2.0
// Messages on stderr.
#pragma once

#include <fmt/format.h>

#include <cstdio>
#include <string>
#include <utility>

namespace voxelume::cli {

/// Prints to stderr. If that fails, for example because a disk is full or stderr is closed, the
/// message is lost: a run doesn't end because nobody can read its messages.
template <class... Args>
void tell(fmt::format_string<Args...> format, Args&&... args) {
    const std::string text = fmt::format(format, std::forward<Args>(args)...);
    std::fwrite(text.data(), 1, text.size(), stderr);
}

}  // namespace voxelume::cli
