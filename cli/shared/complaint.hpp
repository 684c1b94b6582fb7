// SPDX-License-Identifier: Apache-2.0
// How a failure is told.
#pragma once

#include <string>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// Prints a failure to stderr, as a line that can't steer the terminal; a compiler's log has more.
/// Returns the kind's exit code.
int complain(const std::string& sentence, ErrorKind kind);

}  // namespace voxelume::cli
