// SPDX-License-Identifier: Apache-2.0
// How many cores have nothing to do for anybody else, and so may compile kernels beside a command.
#pragma once

#include <filesystem>

namespace voxelume::cli {

/// Where the system tells of cores, as Linux lays it out.
struct CoreFiles {
    std::filesystem::path load = "/proc/loadavg";
    std::filesystem::path groups = "/proc/self/cgroup";  ///< the process's control groups
    std::filesystem::path mount = "/sys/fs/cgroup";      ///< the folder of all groups
};

/// The cores that the process may use, as its affinity (`taskset`, a job of Slurm) and its control
/// groups (`docker run --cpus`) allow, less the threads of the machine that run at this moment, one
/// of this process among them. It is 0 or less on a busy machine, and where half a core would be
/// left.
int idle_cores(const CoreFiles& files = {});

}  // namespace voxelume::cli
