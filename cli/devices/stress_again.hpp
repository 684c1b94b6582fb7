// SPDX-License-Identifier: Apache-2.0
// The line of a shell that tries one case of `stress` again.
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

/// The command that tries one case of a test again, with the cases that it was tried with.
std::string command_for(const std::string& test, uint64_t number, const StressCommand& command);

}  // namespace voxelume::cli
