// SPDX-License-Identifier: Apache-2.0
// voxelume merge PART...: joins the parts of a run that several processes rendered into the run's
// files, or checks that all parts exist.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <tuple>
#include <utility>
#include <vector>

#include "cli/output/shard_manifest.hpp"
#include "cli/shared/checks.hpp"
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

/// A part, and the file that describes it.
struct Part {
    fs::path file;
    ShardManifest manifest;
};

template <class... Args>
[[noreturn]] void refuse(fmt::format_string<Args...> format, Args&&... args) {
    throw Error(ErrorKind::input, "merge: " + fmt::format(format, std::forward<Args>(args)...));
}

/// The reason why two parts don't belong to one run; empty if they do.
std::string difference(const ShardManifest& a, const ShardManifest& b) {
    if (a.shard.count != b.shard.count)
        return fmt::format("one is of {} parts, the other of {}", a.shard.count, b.shard.count);
    if (a.frames != b.frames) return "they have different frames";
    if (a.outputs != b.outputs) return "they have different outputs";
    if (a.rows.has_value() != b.rows.has_value() ||
        (a.rows && (a.rows->height != b.rows->height || a.rows->outputs != b.rows->outputs)))
        return "their images differ in size";
    const auto options = [](const ImageFileOptions& o) {
        return std::tuple(o.exposure, o.view_transform, o.png_bits, o.float_color, o.multi_part);
    };
    if (options(a.options) != options(b.options) || a.options.channels != b.options.channels)
        return "their options of images differ";
    if (a.scene != b.scene || (a.rows && a.rows->hash != b.rows->hash))
        return "the scene, one of its files, its settings or the version differ";
    return {};
}

void check_same_run(const std::vector<Part>& parts) {
    const Part& first = parts.front();
    for (const Part& part : parts)
        if (const std::string reason = difference(first.manifest, part.manifest); !reason.empty())
            refuse("{} and {} are parts of different runs: {}", first.file.string(),
                   part.file.string(), reason);
}

/// Throws if a part is missing or exists twice.
void check_numbers(const std::vector<Part>& parts) {
    std::map<int, const Part*> known;
    for (const Part& part : parts) {
        const auto [other, is_new] = known.emplace(part.manifest.shard.number, &part);
        if (!is_new)
            refuse("{} and {} are both part {}; leave one out", other->second->file.string(),
                   part.file.string(), text_of(part.manifest.shard));
    }
    constexpr size_t kMaxNames = 20;
    std::vector<std::string> missing;
    const int count = parts.front().manifest.shard.count;
    for (int number = 1; number <= count && missing.size() <= kMaxNames; ++number)
        if (!known.contains(number)) missing.push_back(std::to_string(number));
    if (missing.empty()) return;
    if (missing.size() > kMaxNames) missing.back() = "...";
    const fs::path output =
        parts.front().file.parent_path() / parts.front().manifest.outputs.front();
    refuse("{}: of {} parts {} {} missing: {}", output.string(), count, count - int(known.size()),
           count - int(known.size()) == 1 ? "is" : "are", fmt::join(missing, ", "));
}

/// The path of a part's file, after checking that its bytes are those that the manifest lists.
fs::path checked_file(const Part& part, const ShardFile& file) {
    fs::path path = part.file.parent_path() / file.name;
    if (const std::string hash = hash_of_file(path); hash != file.hash)
        refuse("{}: {}; render part {} again, with --resume", path.string(),
               hash.empty() ? "isn't there" : "isn't as it was rendered",
               text_of(part.manifest.shard));
    return path;
}

/// Checks that every frame of the run belongs to one part, and that its files are as they were
/// written.
void check_frames(const std::vector<Part>& parts) {
    std::map<int, const Part*> known;
    for (const Part& part : parts)
        for (const ShardManifest::Frame& frame : part.manifest.own) {
            const auto [other, is_new] = known.emplace(frame.frame, &part);
            if (!is_new)
                refuse("frame {} is in both {} and {}", frame.frame, other->second->file.string(),
                       part.file.string());
            if (frame.files.empty())
                refuse("{} has no file of frame {}", part.file.string(), frame.frame);
            for (const ShardFile& file : frame.files) checked_file(part, file);
        }
    for (const int frame : parts.front().manifest.frames)
        if (!known.contains(frame)) refuse("no part has frame {}", frame);
}

/// The files of the image that a part belongs to. A part may come from someone else, so the files
/// must lie in the part's folder after links are followed, unless files may lie `outside`.
std::vector<fs::path> checked_outputs(const Part& part, bool outside) {
    std::vector<fs::path> outputs;
    const fs::path folder = fs::weakly_canonical(fs::absolute(part.file).parent_path());
    for (const std::string& name : part.manifest.rows->outputs) {
        const fs::path& output = outputs.emplace_back(part.file.parent_path() / name);
        const fs::path inside = fs::weakly_canonical(folder / name).lexically_relative(folder);
        if (!outside && (inside.empty() || *inside.begin() == ".."))
            refuse("{} would write {}, outside of its folder; --outside lets it",
                   part.file.string(), output.string());
    }
    return outputs;
}

/// Writes the files of an image of which each part has some rows. Returns these files.
std::vector<fs::path> merge_rows(const std::vector<Part>& parts, bool outside) {
    std::vector<fs::path> files;
    std::vector<fs::path> outputs = checked_outputs(parts.front(), outside);
    int height = 0;
    for (const Part& part : parts) {
        const ShardRows& rows = *part.manifest.rows;
        if (rows.first != height)
            refuse("{} begins with row {} instead of row {}", part.file.string(), rows.first,
                   height);
        height = rows.end;
        if (rows.file) files.push_back(checked_file(part, *rows.file));
    }
    const ShardRows& rows = *parts.front().manifest.rows;
    if (height != rows.height) refuse("the parts have {} of {} rows", height, rows.height);
    merge_image_files(files, outputs, rows.hash, parts.front().manifest.options);
    return outputs;
}

void merge_run(std::vector<Part> parts, const MergeCommand& command) {
    check_same_run(parts);
    check_numbers(parts);
    std::ranges::sort(parts, {}, [](const Part& part) { return part.manifest.shard.number; });
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

/// The parts of each run, by its first output: a call with several inputs, views or values creates
/// parts of several runs.
using Runs = std::map<std::string, std::vector<Part>>;

bool has_twins(const std::vector<Part>& parts) {
    std::set<int> numbers;
    for (const Part& part : parts)
        if (!numbers.insert(part.manifest.shard.number).second) return true;
    return false;
}

/// Separates runs in different folders whose outputs have the same name, which shows in parts that
/// occur twice. The parts of one run may also lie in several folders.
Runs told_apart(Runs runs) {
    Runs all;
    for (auto& [output, parts] : runs) {
        const bool apart = has_twins(parts);
        for (Part& part : parts) {
            const fs::path folder = part.file.parent_path().lexically_normal();
            all[apart ? (folder / output).string() : output].push_back(std::move(part));
        }
    }
    return all;
}

Runs read_runs(const MergeCommand& command) {
    Runs runs;
    for (const std::string& file : command.parts) {
        if (file.ends_with(".shard.exr")) continue;
        ShardManifest manifest = read_manifest(file);
        const std::string output = manifest.outputs.empty() ? "" : manifest.outputs.front();
        runs[output].push_back({file, std::move(manifest)});
    }
    if (runs.empty()) fail_usage("merge: name the files .shard of the parts, not their images");
    return told_apart(std::move(runs));
}

/// Merges all runs. A run that can't be merged doesn't stop those after it.
int run(const MergeCommand& command) {
    Runs runs = read_runs(command);
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
