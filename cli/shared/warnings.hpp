// SPDX-License-Identifier: Apache-2.0
// Prints warnings on the terminal, one per line.
#pragma once

#include <functional>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// The text as one line that can't control the terminal, whatever a file's name contains.
std::string harmless_line(std::string text);

/// Prints "warning: WHERE: TEXT" to stderr.
void print_warning(const Warning& warning);

/// A function that calls `before` and then prints the warning that it gets. With `strict` it leaves
/// out the first warning, because the error that ends the call contains it.
std::function<void(const Warning&)> warning_printer(bool strict, std::function<void()> before);

/// Prints the warnings that were found without rendering, unless `quiet`. With `strict`, throws
/// Error::scene with the first warning, if there is one, and prints only the others.
void tell_warnings(const std::vector<Warning>& warnings, bool quiet, bool strict);

/// Prints a note for each base of the cache that isn't read, unless `quiet`: its contents will be
/// compiled again.
void tell_unread_bases(bool quiet);

}  // namespace voxelume::cli
