// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/main_memory.hpp"

#include <fmt/format.h>
#include <sys/resource.h>
#include <unistd.h>

#include <algorithm>
#include <atomic>
#include <fstream>
#include <limits>
#include <string>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kNoLimit = std::numeric_limits<uint64_t>::max();

std::atomic<uint64_t> chosen_limit = kNoLimit;

/// The number in a file of one line; without one, as in "max", there is no limit.
uint64_t limit_in(const fs::path& file) {
    std::ifstream stream(file);
    uint64_t bytes = 0;
    return stream >> bytes ? bytes : kNoLimit;
}

/// The lowest limit of a group and of the groups around it. A container often sees its own group as
/// the root, while the group's path is the one outside: folders that don't exist set no limit.
uint64_t limit_of_group(const fs::path& root, const fs::path& group, const char* file) {
    uint64_t min = limit_in(root / file);
    fs::path folder = root;
    for (const fs::path& part : group.relative_path())
        min = std::min(min, limit_in((folder /= part) / file));
    return min;
}

uint64_t process_limit(int resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
    return limit.rlim_cur;
}

/// The memory that the machine and the system allow; doesn't change while a program runs.
uint64_t allowed_memory() {
    const uint64_t machine = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
    return std::min({machine, control_group_memory("/proc/self/cgroup", "/sys/fs/cgroup"),
                     process_limit(RLIMIT_DATA), process_limit(RLIMIT_AS)});
}

/// Bytes of the process that are in main memory; 0 where the system doesn't tell.
uint64_t resident_memory() {
    std::ifstream stream("/proc/self/statm");
    uint64_t pages = 0, resident = 0;
    return stream >> pages >> resident ? resident * uint64_t(sysconf(_SC_PAGE_SIZE)) : 0;
}

}  // namespace

uint64_t main_memory() {
    static const uint64_t allowed = allowed_memory();
    return std::min(allowed, chosen_limit.load());
}

void limit_main_memory(uint64_t bytes) {
    chosen_limit = bytes == 0 ? kNoLimit : bytes;
}

bool has_room_for(double bytes) {
    return bytes + double(resident_memory()) <= double(main_memory());
}

void require_room(const fs::path& file, std::string_view what, double bytes) {
    if (has_room_for(bytes)) return;
    throw Error(ErrorKind::limit,
                "{}: {} takes {:.3g} GB in addition to the {:.3g} GB that this process holds, and "
                "it may hold {:.3g} GB: allow it more memory",
                SourcePlace(file.string()), what, bytes / 1e9, double(resident_memory()) / 1e9,
                double(main_memory()) / 1e9);
}

uint64_t chosen_memory_limit() {
    return chosen_limit;
}

uint64_t control_group_memory(const fs::path& groups, const fs::path& mount) {
    std::ifstream stream(groups);
    uint64_t min = kNoLimit;
    // "4:memory:/job" of version 1, "0::/job" of version 2.
    for (std::string line; std::getline(stream, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const std::string controllers =
            fmt::format(",{},", line.substr(first + 1, second - first - 1));
        const fs::path group = line.substr(second + 1);
        if (controllers == ",,")
            min = std::min(min, limit_of_group(mount, group, "memory.max"));
        else if (controllers.find(",memory,") != std::string::npos)
            min = std::min(min, limit_of_group(mount / "memory", group, "memory.limit_in_bytes"));
    }
    return min;
}

}  // namespace voxelume
