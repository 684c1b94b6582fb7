// SPDX-License-Identifier: Apache-2.0
// The number of cores that are idle, and so may compile kernels while a command runs.
#pragma once

#include <filesystem>

namespace voxelume::cli {

/// The files in which Linux describes cores.
struct CoreFiles {
    std::filesystem::path load = "/proc/loadavg";
    std::filesystem::path groups = "/proc/self/cgroup";  ///< the process's control groups
    std::filesystem::path mount = "/sys/fs/cgroup";      ///< the folder of all groups
};

/// The cores that the process may use, by its affinity (`taskset`, a job of Slurm) and its control
/// groups (`docker run --cpus`), less the threads of the whole machine that are running now, one of
/// which belongs to this process. The result is 0 or less on a busy machine; fractions of a core
/// don't count.
int idle_cores(const CoreFiles& files = {});

}  // namespace voxelume::cli
