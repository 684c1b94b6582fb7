// SPDX-License-Identifier: Apache-2.0
// Prints the results of a command, for people or for programs.
#pragma once

#include <nlohmann/json.hpp>

namespace voxelume::cli {

using Report = nlohmann::ordered_json;

/// Prints `report` to stdout: as JSON, or as lines of key and value, in which an array of objects
/// becomes a table.
void print_report(const Report& report, bool as_json);

}  // namespace voxelume::cli
