// SPDX-License-Identifier: Apache-2.0
// The parts that `merge` is called with -> the parts of each run.
#pragma once

#include <map>
#include <string>
#include <vector>

#include "cli/files/merge_parts.hpp"

namespace voxelume::cli {

/// The parts of each run, by its first output: a call with several inputs, views or values leaves
/// those of several.
using MergeRuns = std::map<std::string, std::vector<MergePart>>;

/// Reads the manifests among `files`; images of parts are skipped. The parts of one run may lie in
/// several folders. So may runs whose outputs have one name.
///
/// Throws Error::usage if no manifest is among them, Error::input as read_manifest does.
MergeRuns read_runs(const std::vector<std::string>& files);

}  // namespace voxelume::cli
