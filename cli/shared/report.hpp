// SPDX-License-Identifier: Apache-2.0
// What a command found out, for people or for programs.
#pragma once

#include <nlohmann/json.hpp>

namespace voxelume::cli {

using Report = nlohmann::ordered_json;

/// Prints `report` to stdout: as JSON, or as lines of key and value, where an array of objects is a
/// table.
void print_report(const Report& report, bool as_json);

}  // namespace voxelume::cli
