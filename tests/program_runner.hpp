// Runs the built program and takes what it says.
#pragma once

#include <sys/wait.h>

#include <cstdlib>
#include <filesystem>
#include <string>

#include "tests/file_fixture.hpp"

namespace voxelume {

struct ProgramResult {
    int exit_code = -1;  ///< -1: ended by a signal
    std::string out, err;
};

/// Tests of the command line: the program runs in the test's folder.
class ProgramTest : public FileTest {
  protected:
    /// `arguments` are a shell's words.
    ProgramResult run(const std::string& arguments) const {
        const std::string quoted = "'" + folder.string() + "'";
        const std::string line = "cd " + quoted + " && '" VXL_BINARY "' " + arguments +
                                 " >stdout.txt 2>stderr.txt </dev/null";
        const int status = std::system(line.c_str());
        return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(folder / "stdout.txt"),
                bytes_of(folder / "stderr.txt")};
    }
};

}  // namespace voxelume
