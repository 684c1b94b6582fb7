// SPDX-License-Identifier: Apache-2.0
// The number of cores on which nothing runs.
#pragma once

#include <filesystem>

#include "runtime/base/control_groups.hpp"

namespace voxelume {

/// The cores that the process may use, by its affinity (`taskset`, a job of Slurm) and its control
/// groups (`docker run --cpus`), less the threads of the whole machine that are running now, one of
/// which belongs to this process. The result is 0 or less on a busy machine; fractions of a core
/// don't count.
///
/// @param load  the file in which Linux counts running threads
int count_idle_cores(const ControlGroupFiles& groups = {},
                     const std::filesystem::path& load = "/proc/loadavg");

}  // namespace voxelume
