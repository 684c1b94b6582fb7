// SPDX-License-Identifier: Apache-2.0
// The outcome of several jobs of a run.
#pragma once

#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// The outcome of several jobs.
struct Tally {
    size_t done = 0;
    std::vector<std::string> failed;  ///< their names
    ErrorKind kind = ErrorKind::render;

    /// Adds a failure. If all failures are of one kind, the run gets that kind's exit code.
    void add(const std::string& name, ErrorKind failure) {
        kind = failed.empty() || kind == failure ? failure : ErrorKind::render;
        failed.push_back(name);
    }
};

/// Prints how many jobs were rendered, in how many seconds, and which failed.
void print_tally(const Tally& tally, double seconds);

}  // namespace voxelume::cli
