// SPDX-License-Identifier: Apache-2.0
// What became of several jobs of a run.
#pragma once

#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// What became of several jobs.
struct Tally {
    size_t done = 0;
    std::vector<std::string> failed;  ///< their names
    ErrorKind kind = ErrorKind::render;

    /// Failures of one kind have its exit code.
    void add(const std::string& name, ErrorKind failure) {
        kind = failed.empty() || kind == failure ? failure : ErrorKind::render;
        failed.push_back(name);
    }
};

/// Tells how many were rendered, in how many seconds, and which failed.
void print_tally(const Tally& tally, double seconds);

}  // namespace voxelume::cli
