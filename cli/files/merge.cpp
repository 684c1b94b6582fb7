// SPDX-License-Identifier: Apache-2.0
// voxelume merge PART...: joins the parts of a run that several processes rendered into the run's
// files, or checks that all parts exist.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/files/merge_runs.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/complaint.hpp"
#include "cli/shared/tell.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

struct MergeCommand {
    std::vector<std::string> parts;
    bool outside = false;
    bool quiet = false;
};

/// Writes the files of an image of which each part has some rows. Returns them.
std::vector<fs::path> merge_rows(const std::vector<MergePart>& parts, bool outside) {
    std::vector<fs::path> files;
    std::vector<fs::path> outputs = checked_outputs(parts.front(), outside);
    int height = 0;
    for (const MergePart& part : parts) {
        const ShardRows& rows = *part.manifest.rows;
        if (rows.first != height)
            refuse_merge("{} begins with row {} instead of row {}", part.file.string(), rows.first,
                         height);
        height = rows.end;
        if (rows.file) files.push_back(checked_file(part, *rows.file));
    }
    const ShardRows& rows = *parts.front().manifest.rows;
    if (height != rows.height) refuse_merge("the parts have {} of {} rows", height, rows.height);
    merge_image_files(files, outputs, rows.hash, parts.front().manifest.options);
    return outputs;
}

void merge_run(std::vector<MergePart> parts, const MergeCommand& command) {
    check_same_run(parts);
    check_numbers(parts);
    std::ranges::sort(parts, {}, [](const MergePart& part) { return part.manifest.shard.number; });
    const auto say = [&](const std::string& what) {
        if (!command.quiet) tell("{} of {} parts\n", what, parts.size());
    };
    if (parts.front().manifest.rows) {
        for (const fs::path& file : merge_rows(parts, command.outside)) say(file.string());
    } else {
        check_frames(parts);
        say(fmt::format("all {} frames are there, whole,", parts.front().manifest.frames.size()));
    }
}

/// A run that can't be merged doesn't stop those after it.
int run(const MergeCommand& command) {
    MergeRuns runs = read_runs(command.parts);
    if (runs.size() == 1) {
        merge_run(std::move(runs.begin()->second), command);
        return 0;
    }
    size_t failed = 0;
    ErrorKind kind = ErrorKind::input;
    for (auto& [output, parts] : runs) {
        try {
            merge_run(std::move(parts), command);
        } catch (const Error& error) {
            complain(error.what(), error.kind());
            kind = failed++ == 0 || kind == error.kind() ? error.kind() : ErrorKind::render;
        }
    }
    if (!command.quiet) tell("{} of {} runs merged\n", runs.size() - failed, runs.size());
    return failed == 0 ? 0 : static_cast<int>(kind);
}

}  // namespace

Action add_merge(CLI::App& app) {
    const auto command = std::make_shared<MergeCommand>();
    app.add_option("PART", command->parts,
                   "files .shard of all parts, of `render --shard`; files .shard.exr are skipped")
        ->required();
    app.add_flag("--outside", command->outside,
                 "write images outside of the folder of their parts, too, where the parts say so");
    app.add_flag("-q,--quiet", command->quiet, "print errors only");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
