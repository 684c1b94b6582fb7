// SPDX-License-Identifier: Apache-2.0
// Warnings on the terminal, each a line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// One line that can't steer the terminal, whatever is in a file's name.
std::string harmless_line(std::string text);

/// Prints "warning: WHERE: TEXT" to stderr.
void print_warning(const Warning& warning);

/// A function that prints each warning it gets, after `before` was called; with `strict` all but
/// the first, which the error says that the call ends with.
std::function<void(const Warning&)> warning_printer(bool strict, std::function<void()> before);

/// Prints the warnings that were found without rendering, unless `quiet`. With `strict` throws
/// Error::scene with the first one instead, if there is one, and prints the others.
void tell_warnings(const std::vector<Warning>& warnings, bool quiet, bool strict);

/// Prints a note for each base of the cache that isn't read, unless `quiet`: what is in it will be
/// compiled again.
void tell_unread_bases(bool quiet);

}  // namespace voxelume::cli
