// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/helper/helper_limits.hpp"

#include <sys/prctl.h>
#include <sys/resource.h>

#include <algorithm>
#include <csignal>

#include "runtime/base/sanitizers.hpp"

namespace voxelume {
namespace {

/// Lowers a limit; one that is lower already stays. The process may raise it again by `grace`, or
/// ignore the system's signal for so long.
bool set_limit(__rlimit_resource_t resource, uint64_t value, uint64_t grace = 0) {
    rlimit limit{};
    if (getrlimit(resource, &limit) != 0) return false;
    limit.rlim_max = std::min<rlim_t>(limit.rlim_max, value + grace);
    limit.rlim_cur = std::min<rlim_t>(limit.rlim_max, value);
    return setrlimit(resource, &limit) == 0;
}

}  // namespace

bool limit_helper(const HelperLimits& limits) {
    constexpr uint64_t kFiles = 32;  // the thread pool looks into a few while it starts
    bool is_limited = prctl(PR_SET_PDEATHSIG, SIGKILL) == 0;
    is_limited &= prctl(PR_SET_NO_NEW_PRIVS, 1, 0, 0, 0) == 0;
    is_limited &= set_limit(RLIMIT_CORE, 0) && set_limit(RLIMIT_FSIZE, 0);
    is_limited &= set_limit(RLIMIT_CPU, limits.seconds, 5) && set_limit(RLIMIT_NOFILE, kFiles);
    if (!kHasSanitizer)
        is_limited &= set_limit(RLIMIT_AS, limits.memory_bytes,
                                limits.max_memory_bytes - limits.memory_bytes);
    return is_limited;
}

void raise_memory_limit() {
    rlimit limit{};
    if (getrlimit(RLIMIT_AS, &limit) != 0) return;
    limit.rlim_cur = limit.rlim_max;
    setrlimit(RLIMIT_AS, &limit);  // a failure shows as a lack of memory
}

}  // namespace voxelume
