// SPDX-License-Identifier: Apache-2.0
// What is in the statistics of a run; cli/STATISTICS.md describes their keys.
#include "runtime/api/describe/describe.hpp"

namespace voxelume::api {

Report describe_statistics(const Report& statistics) {
    Report report = {{"kind", "statistics of a run"}};
    for (const char* key : {"version", "device", "size", "volume_size", "files", "warnings"})
        if (statistics.contains(key)) report[key] = statistics[key];
    const auto frames = statistics.find("frames");
    if (frames != statistics.end()) report["frames"] = frames->size();
    for (const char* key : {"peak_device_bytes", "seconds"})
        if (statistics.contains(key)) report[key] = statistics[key];
    return report;
}

}  // namespace voxelume::api
