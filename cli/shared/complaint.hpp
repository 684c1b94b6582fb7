// SPDX-License-Identifier: Apache-2.0
// Prints failures.
#pragma once

#include <string>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// Prints a failure to stderr, as one line without control characters for the terminal; a
/// compiler's log has more lines. Returns the kind's exit code.
int complain(const std::string& sentence, ErrorKind kind);

}  // namespace voxelume::cli
