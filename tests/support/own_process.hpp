// SPDX-License-Identifier: Apache-2.0
// Runs tests of a program in processes of their own.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

namespace voxelume {

/// Runs a disabled test of this program, such as "Suite.DISABLED_Name", in a new process with
/// additional environment variables, "A=1 B=2", and a PoCL folder that this program chooses.
/// Returns its exit code, or -1 if a signal ended it.
inline int run_own_test(const std::string& test, const std::string& environment) {
    const std::string self = std::filesystem::read_symlink("/proc/self/exe").string();
    const std::string command = fmt::format(
        "env -u POCL_CACHE_DIR {} \"{}\" --gtest_also_run_disabled_tests --gtest_filter={} "
        ">/dev/null",
        environment, self, test);
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
}

}  // namespace voxelume
