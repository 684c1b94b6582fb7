// SPDX-License-Identifier: Apache-2.0
// CPU time of this process over all its threads, which doesn't depend on other users of a shared
// machine; wall time for accelerators; and medians.
#pragma once

#include <sys/resource.h>

#include <algorithm>
#include <chrono>
#include <vector>

namespace voxelume {

inline double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

/// True if an accelerator is measured. Its work takes no CPU time of this process.
inline bool measures_accelerator = false;

/// CPU time, or wall time where an accelerator is measured.
inline double busy_seconds() {
    if (!measures_accelerator) return cpu_seconds();
    const auto now = std::chrono::steady_clock::now().time_since_epoch();
    return std::chrono::duration<double>(now).count();
}

inline double median_of(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

}  // namespace voxelume
