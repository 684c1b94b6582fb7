// SPDX-License-Identifier: Apache-2.0
// What `doctor` tells of the machine: system, environment, cache.
#pragma once

#include "cli/shared/report.hpp"

namespace voxelume::cli {

/// The program's version and build, the system, and its main memory.
Report system_report();

/// The variables that change what Voxelume or its OpenCL does.
Report environment_report();

/// The folders of the cache, and what is in the user's own. The text form calls the column "cache
/// base", because its table has no heading but the columns'.
Report cache_report(bool as_json);

}  // namespace voxelume::cli
