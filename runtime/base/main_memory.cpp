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
std::atomic<uint64_t> claimed_bytes = 0;

/// The number in a file of one line; without one, as in "max", there is no limit.
uint64_t limit_in(const fs::path& file) {
    std::ifstream stream(file);
    uint64_t bytes = 0;
    return stream >> bytes ? bytes : kNoLimit;
}

uint64_t process_limit(int resource) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0 || limit.rlim_cur == RLIM_INFINITY) return kNoLimit;
    return limit.rlim_cur;
}

/// The memory that the machine and the system allow; doesn't change while a program runs.
uint64_t allowed_memory() {
    const uint64_t machine = uint64_t(sysconf(_SC_PHYS_PAGES)) * uint64_t(sysconf(_SC_PAGE_SIZE));
    return std::min(
        {machine, control_group_memory({}), process_limit(RLIMIT_DATA), process_limit(RLIMIT_AS)});
}

/// Bytes of the process that are in main memory; 0 where the system doesn't tell.
uint64_t resident_memory() {
    std::ifstream stream("/proc/self/statm");
    uint64_t pages = 0, resident = 0;
    return stream >> pages >> resident ? resident * uint64_t(sysconf(_SC_PAGE_SIZE)) : 0;
}

/// main_memory() without claims.
uint64_t memory_limit() {
    static const uint64_t allowed = allowed_memory();
    return std::min(allowed, chosen_limit.load());
}

}  // namespace

uint64_t main_memory() {
    const uint64_t limit = memory_limit();
    return limit - std::min(limit, claimed_bytes.load());
}

uint64_t claimed_memory() {
    return claimed_bytes;
}

MainMemoryClaim::MainMemoryClaim(uint64_t bytes) : bytes_(bytes) {
    claimed_bytes += bytes_;
}

MainMemoryClaim::~MainMemoryClaim() {
    claimed_bytes -= bytes_;
}

void limit_main_memory(uint64_t bytes) {
    chosen_limit = bytes == 0 ? kNoLimit : bytes;
}

bool has_room_for(double bytes) {
    return bytes + double(resident_memory()) <= double(memory_limit());
}

void require_room(const fs::path& file, std::string_view what, double bytes) {
    if (has_room_for(bytes)) return;
    throw Error(ErrorKind::limit,
                "{}: {} takes {:.3g} GB in addition to the {:.3g} GB that this process holds, and "
                "it may hold {:.3g} GB: allow it more memory",
                SourcePlace(file.string()), what, bytes / 1e9, double(resident_memory()) / 1e9,
                double(memory_limit()) / 1e9);
}

uint64_t chosen_memory_limit() {
    return chosen_limit;
}

uint64_t control_group_memory(const ControlGroupFiles& files) {
    uint64_t min = kNoLimit;
    visit_control_groups(files, "memory", [&](const fs::path& group, ControlGroupVersion version) {
        const bool is_second = version == ControlGroupVersion::second;
        min = std::min(min, limit_in(group / (is_second ? "memory.max" : "memory.limit_in_bytes")));
    });
    return min;
}

}  // namespace voxelume
