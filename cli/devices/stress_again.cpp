// SPDX-License-Identifier: Apache-2.0
#include "cli/devices/stress_again.hpp"

#include <fmt/format.h>

#include <array>
#include <cstdlib>

#include "cli/shared/shell_text.hpp"

namespace voxelume::cli {
namespace {

/// Environment variables that affect what a device does.
constexpr std::array kSettingsOfTests = {
    "VOXELUME_DEVICE",    "VOXELUME_LANES",     "VOXELUME_WORK_GROUP",
    "VOXELUME_UNITS",     "VOXELUME_BUFFER_MB", "VOXELUME_BUILD_OPTIONS",
    "VOXELUME_SELF_TEST", "VOXELUME_BATCH",     "POCL_MAX_PTHREAD_COUNT"};

/// The text as one word of a shell command.
std::string shell_word(const std::string& text) {
    const char* plain = "abcdefghijklmnopqrstuvwxyzABCDEFGHIJKLMNOPQRSTUVWXYZ0123456789-_=+,./:@%";
    if (!text.empty() && text.find_first_not_of(plain) == std::string::npos) return text;
    return quoted(text);
}

}  // namespace

std::string command_for(const std::string& test, uint64_t number, const StressCommand& command) {
    std::string text;
    for (const char* name : kSettingsOfTests)
        if (const char* value = std::getenv(name); value && *value)
            text += fmt::format("{}={} ", name, shell_word(value));
    text += fmt::format("voxelume stress --only {} --seed {} --rays 1 --first {}", test,
                        command.seed, number);
    if (!command.device.empty()) text += " --device " + shell_word(command.device);
    return text;
}

}  // namespace voxelume::cli
