// SPDX-License-Identifier: Apache-2.0
// Faults that the readers of volumes must withstand: any truncation, any changed byte, a full disk.
#pragma once

#include <random>

#include "runtime/io/volume_file.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/program_runner.hpp"

namespace voxelume {

/// Truncates `damaged` after every `stride`-th byte and reads `opened`, which is the same file or
/// its header.
inline void expect_truncations_refused(const std::filesystem::path& damaged,
                                       const std::filesystem::path& opened, size_t stride) {
    const std::string bytes = bytes_of(damaged);
    for (size_t length = 0; length < bytes.size(); length += stride) {
        put_bytes(damaged, bytes.substr(0, length));
        EXPECT_EQ(error_of([&] { read_volume(opened); }).exit_code(), 4) << length;
    }
    put_bytes(damaged, bytes);
}

/// The number of changed bytes that the reader refuses. Any other change must leave the content
/// intact, for example because the byte was in a comment.
inline size_t count_refused_changes(const std::filesystem::path& damaged,
                                    const std::filesystem::path& opened, size_t trials) {
    const std::string bytes = bytes_of(damaged);
    std::mt19937 random(1971);
    size_t refused = 0;
    for (size_t trial = 0; trial < trials; ++trial) {
        std::string changed = bytes;
        changed[random() % bytes.size()] ^= char(1 + random() % 255);
        put_bytes(damaged, changed);
        try {
            read_volume(opened);
        } catch (const Error& error) {
            EXPECT_EQ(error.exit_code(), 4) << "trial " << trial;
            ++refused;
        }
    }
    put_bytes(damaged, bytes);
    return refused;
}

/// Expects that writing fails at every limit below the file's size, and leaves nothing behind.
inline void expect_full_disk_leaves_nothing(const std::filesystem::path& path,
                                            const Volume& volume) {
    write_volume(path, volume);
    const auto size = std::filesystem::file_size(path);
    std::filesystem::remove(path);
    for (rlim_t limit = 1; limit < size; limit += 1 + size / 17) {
        const FileSizeLimit full(limit);
        EXPECT_EQ(error_of([&] { write_volume(path, volume); }).exit_code(), 5) << limit;
        EXPECT_FALSE(std::filesystem::exists(path)) << limit;
    }
}

/// Another program's exit code and output; the code is 127 if it isn't installed.
inline ProgramResult run_tool(const std::filesystem::path& folder, const std::string& line) {
    const std::string whole =
        fmt::format("cd '{}' && {} >tool.txt 2>&1 </dev/null", folder.string(), line);
    const int status = std::system(whole.c_str());
    return {WIFEXITED(status) ? WEXITSTATUS(status) : -1, bytes_of(folder / "tool.txt"), {}};
}

}  // namespace voxelume
