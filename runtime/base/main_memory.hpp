// SPDX-License-Identifier: Apache-2.0
// How much main memory the process may take.
#pragma once

#include <cstdint>
#include <filesystem>
#include <string_view>

#include "runtime/base/control_groups.hpp"

namespace voxelume {

/// Bytes: those of the machine, or fewer where the process's control group (a container, a job of
/// Slurm), its limits (`ulimit -d` and `-v`) or limit_main_memory() allow fewer; less what is
/// claimed.
uint64_t main_memory();

/// Makes main_memory() return at most `bytes`; 0 removes this limit. Any thread may call it.
void limit_main_memory(uint64_t bytes);

/// Main memory for what several renderings make together, which neither of them counts: while this
/// exists, main_memory() is less by its bytes. What is there of it already counts as held.
class MainMemoryClaim {
  public:
    explicit MainMemoryClaim(uint64_t bytes);
    ~MainMemoryClaim();
    MainMemoryClaim(const MainMemoryClaim&) = delete;
    MainMemoryClaim& operator=(const MainMemoryClaim&) = delete;

  private:
    uint64_t bytes_;
};

/// The bytes that are claimed.
uint64_t claimed_memory();

/// True if the process may take this many bytes in addition to what it holds (its resident memory).
bool has_room_for(double bytes);

/// Throws Error::limit, which names the file and `what` takes the bytes, if there is no room.
void require_room(const std::filesystem::path& file, std::string_view what, double bytes);

/// The limit of limit_main_memory(); the largest number without one.
uint64_t chosen_memory_limit();

/// The minimum of the limits that control groups of both versions set for a process. Without any,
/// it is the largest number.
uint64_t control_group_memory(const ControlGroupFiles& files);

}  // namespace voxelume
