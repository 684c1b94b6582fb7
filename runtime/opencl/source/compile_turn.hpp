// SPDX-License-Identifier: Apache-2.0
// The turn of one process to compile what a cache lacks, while others that lack it wait.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "runtime/base/files/disk_cache.hpp"
#include "runtime/base/files/private_folder.hpp"

namespace voxelume {

/// Processes that start together on a cold cache would each compile the same kernels. The first
/// that misses an entry takes the turn for it; others wait until it has kept what it compiled.
///
/// The turn is a lock on a hidden file next to the entry. It ends with its process, however that
/// ends. A process waits for at most a minute in all, and never while it has a turn, so that no two
/// wait for each other. Where no file can be made there are no turns: then each process compiles.
class CompileTurn {
  public:
    explicit CompileTurn(std::chrono::steady_clock::duration longest_wait = std::chrono::minutes(1))
        : longest_wait_(longest_wait) {}
    ~CompileTurn() { release(); }
    CompileTurn(const CompileTurn&) = delete;
    CompileTurn& operator=(const CompileTurn&) = delete;

    /// The entry of the key, which another process may just have written. If there is none, this
    /// process is to compile it, and gets the turn if possible.
    std::optional<std::string> read(const DiskCache& cache, const std::string& key);

    void release();
    bool is_taken() const { return file_ >= 0; }

  private:
    bool take(const DiskCache& cache, const std::string& key);

    std::optional<PrivateFolder> folder_;
    std::string name_;
    int file_ = -1;
    std::chrono::steady_clock::duration longest_wait_, waited_{0};
};

}  // namespace voxelume
