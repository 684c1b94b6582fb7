// SPDX-License-Identifier: Apache-2.0
// CPU time of this process over all its threads, which a shared machine's clock doesn't tell, and
// medians.
#pragma once

#include <sys/resource.h>

#include <algorithm>
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

inline double median_of(std::vector<double> values) {
    std::ranges::nth_element(values, values.begin() + ptrdiff_t(values.size() / 2));
    return values[values.size() / 2];
}

}  // namespace voxelume
