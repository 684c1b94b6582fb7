// SPDX-License-Identifier: Apache-2.0
// Runs the built program and returns its output.
#pragma once

#include <fmt/format.h>
#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/support/file_fixture.hpp"

namespace voxelume {

struct ProgramResult {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out, err;
};

/// Tests of the command line: the program runs in the test's folder.
class ProgramTest : public FileTest {
  protected:
    /// Runs the program; `arguments` are words of a shell.
    ProgramResult run(const std::string& arguments) const {
        return run_line(fmt::format("'{}' {}", VXL_BINARY, arguments));
    }

    /// Runs a whole shell command line, which finds `voxelume`.
    ProgramResult run_line(const std::string& line) const {
        const std::filesystem::path programs = std::filesystem::path(VXL_BINARY).parent_path();
        const int status = std::system(
            fmt::format("cd '{}' && PATH='{}':$PATH && {} >stdout.txt 2>stderr.txt </dev/null",
                        folder.string(), programs.string(), line)
                .c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(folder / "stdout.txt"),
                bytes_of(folder / "stderr.txt")};
    }
};

}  // namespace voxelume
