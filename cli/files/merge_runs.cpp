// SPDX-License-Identifier: Apache-2.0
#include "cli/files/merge_runs.hpp"

#include <filesystem>
#include <set>
#include <utility>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

bool has_twins(const std::vector<MergePart>& parts) {
    std::set<int> numbers;
    for (const MergePart& part : parts)
        if (!numbers.insert(part.manifest.shard.number).second) return true;
    return false;
}

/// The parts of one run may lie in several folders. So may runs whose outputs have one name.
MergeRuns told_apart(MergeRuns runs) {
    MergeRuns all;
    for (auto& [output, parts] : runs) {
        const bool apart = has_twins(parts);
        for (MergePart& part : parts) {
            const fs::path folder = part.file.parent_path().lexically_normal();
            all[apart ? (folder / output).string() : output].push_back(std::move(part));
        }
    }
    return all;
}

}  // namespace

MergeRuns read_runs(const std::vector<std::string>& files) {
    MergeRuns runs;
    for (const std::string& file : files) {
        if (file.ends_with(".shard.exr")) continue;
        ShardManifest manifest = read_manifest(file);
        const std::string output = manifest.outputs.empty() ? "" : manifest.outputs.front();
        runs[output].push_back({file, std::move(manifest)});
    }
    if (runs.empty()) fail_usage("merge: name the files .shard of the parts, not their images");
    return told_apart(std::move(runs));
}

}  // namespace voxelume::cli
