// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/idle_cores.hpp"

#include <sched.h>

#include <algorithm>
#include <fstream>
#include <limits>
#include <string>
#include <system_error>
#include <thread>

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

constexpr double kNoLimit = std::numeric_limits<double>::infinity();

/// The cores that a group's quota allows: microseconds on all cores per period. Version 2 has both
/// numbers in one file, "max 100000" without a quota; version 1 has two files, with -1 for no
/// quota.
double quota(const fs::path& group, bool is_version_2) {
    double time = -1, period = 0;
    if (is_version_2) {
        std::ifstream(group / "cpu.max") >> time >> period;
    } else {
        std::ifstream(group / "cpu.cfs_quota_us") >> time;
        std::ifstream(group / "cpu.cfs_period_us") >> period;
    }
    return time > 0 && period > 0 ? time / period : kNoLimit;
}

/// The minimum quota of a group and its parent groups. Containers often see their own group as the
/// root, but its path as it is outside; folders that don't exist there limit nothing.
double quota_of_groups(const fs::path& root, const fs::path& group, bool is_version_2) {
    double min = quota(root, is_version_2);
    fs::path folder = root;
    for (const fs::path& part : group.relative_path())
        min = std::min(min, quota(folder /= part, is_version_2));
    return min;
}

/// The folder of version 2's groups: where version 1's are mounted, too, it has a name.
fs::path folder_of_version_2(const fs::path& mount) {
    std::error_code error;
    return fs::exists(mount / "cgroup.controllers", error) ? mount : mount / "unified";
}

/// The minimum of the quotas that the process's groups of both versions set.
double quota_of_process(const CoreFiles& files) {
    std::ifstream groups(files.groups);
    double min = kNoLimit;
    // Lines look like "4:cpu,cpuacct:/job" in version 1 and "0::/job" in version 2.
    for (std::string line; std::getline(groups, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers = "," + line.substr(first + 1, second - first - 1) + ",";
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,")
            min = std::min(min, quota_of_groups(folder_of_version_2(files.mount), group, true));
        else if (controllers.find(",cpu,") != std::string::npos)
            min = std::min(min, quota_of_groups(files.mount / "cpu", group, false));
    }
    return min;
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

int idle_cores(const CoreFiles& files) {
    int running = 1;  // threads of all processes, including this one
    std::string average;
    std::ifstream(files.load) >> average >> average >> average >> running;
    return int(std::min(double(bound_cores()), quota_of_process(files))) - running;
}

}  // namespace voxelume::cli
