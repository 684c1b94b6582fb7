// SPDX-License-Identifier: Apache-2.0
// Prints the shell command that runs one case of `stress` again.
#pragma once

#include <cstdint>
#include <string>
#include <vector>

namespace voxelume::cli {

struct StressCommand {
    double rays = 1e6;
    uint64_t seed = 1;
    std::vector<std::string> only;
    uint64_t first = 0;
    std::string device;
    bool quiet = false;
};

/// The command that runs one case of a test again, with the environment variables, seed and device
/// of the first run.
std::string command_for(const std::string& test, uint64_t number, const StressCommand& command);

}  // namespace voxelume::cli
