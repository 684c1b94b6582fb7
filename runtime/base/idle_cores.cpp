// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/idle_cores.hpp"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <thread>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// The cores that a group's quota allows: microseconds on all cores per period. Version 2 has both
/// numbers in one file, "max 100000" without a quota; version 1 has two files, with -1 for no
/// quota.
double quota(const fs::path& group, ControlGroupVersion version) {
    double time = -1, period = 0;
    if (version == ControlGroupVersion::second) {
        std::ifstream(group / "cpu.max") >> time >> period;
    } else {
        std::ifstream(group / "cpu.cfs_quota_us") >> time;
        std::ifstream(group / "cpu.cfs_period_us") >> period;
    }
    return time > 0 && period > 0 ? time / period : std::numeric_limits<double>::infinity();
}

/// The cores that the process is bound to: all, unless its affinity was set. If the system has more
/// than 1,024 cores, which is more than a set holds, the process counts as not bound.
int bound_cores() {
    cpu_set_t bound;
    CPU_ZERO(&bound);
    if (sched_getaffinity(0, sizeof bound, &bound) == 0) return CPU_COUNT(&bound);
    return int(std::thread::hardware_concurrency());
}

}  // namespace

int count_idle_cores(const ControlGroupFiles& groups, const fs::path& load) {
    double cores = bound_cores();
    visit_control_groups(groups, "cpu", [&](const fs::path& folder, ControlGroupVersion version) {
        cores = std::min(cores, quota(folder, version));
    });
    int running = 1;  // threads of all processes, including this one
    std::string average;
    std::ifstream(load) >> average >> average >> average >> running;
    return int(cores) - running;
}

}  // namespace voxelume
