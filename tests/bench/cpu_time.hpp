// CPU time of this process over all its threads: what a shared machine's clock doesn't tell.
#pragma once

#include <sys/resource.h>

namespace voxelume {

inline double cpu_seconds() {
    rusage usage{};
    getrusage(RUSAGE_SELF, &usage);
    const auto seconds = [](const timeval& t) {
        return double(t.tv_sec) + 1e-6 * double(t.tv_usec);
    };
    return seconds(usage.ru_utime) + seconds(usage.ru_stime);
}

}  // namespace voxelume
