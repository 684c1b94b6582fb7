// SPDX-License-Identifier: Apache-2.0
#include "cli/files/merge_parts.hpp"

#include <map>
#include <tuple>

#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

/// Why two parts don't belong to one run; empty if they do.
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

}  // namespace

void check_same_run(const std::vector<MergePart>& parts) {
    const MergePart& first = parts.front();
    for (const MergePart& part : parts)
        if (const std::string reason = difference(first.manifest, part.manifest); !reason.empty())
            refuse_merge("{} and {} are parts of different runs: {}", first.file.string(),
                         part.file.string(), reason);
}

void check_numbers(const std::vector<MergePart>& parts) {
    std::map<int, const MergePart*> known;
    for (const MergePart& part : parts) {
        const auto [other, is_new] = known.emplace(part.manifest.shard.number, &part);
        if (!is_new)
            refuse_merge("{} and {} are both part {}; leave one out", other->second->file.string(),
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
    refuse_merge("{}: of {} parts {} {} missing: {}", output.string(), count,
                 count - int(known.size()), count - int(known.size()) == 1 ? "is" : "are",
                 fmt::join(missing, ", "));
}

fs::path checked_file(const MergePart& part, const ShardFile& file) {
    fs::path path = part.file.parent_path() / file.name;
    if (const std::string hash = hash_of_file(path); hash != file.hash)
        refuse_merge("{}: {}; render part {} again, with --resume", path.string(),
                     hash.empty() ? "isn't there" : "isn't as it was rendered",
                     text_of(part.manifest.shard));
    return path;
}

void check_frames(const std::vector<MergePart>& parts) {
    std::map<int, const MergePart*> known;
    for (const MergePart& part : parts)
        for (const ShardManifest::Frame& frame : part.manifest.own) {
            const auto [other, is_new] = known.emplace(frame.frame, &part);
            if (!is_new)
                refuse_merge("frame {} is in both {} and {}", frame.frame,
                             other->second->file.string(), part.file.string());
            if (frame.files.empty())
                refuse_merge("{} has no file of frame {}", part.file.string(), frame.frame);
            for (const ShardFile& file : frame.files) checked_file(part, file);
        }
    for (const int frame : parts.front().manifest.frames)
        if (!known.contains(frame)) refuse_merge("no part has frame {}", frame);
}

std::vector<fs::path> checked_outputs(const MergePart& part, bool outside) {
    std::vector<fs::path> outputs;
    const fs::path folder = fs::weakly_canonical(fs::absolute(part.file).parent_path());
    for (const std::string& name : part.manifest.rows->outputs) {
        const fs::path& output = outputs.emplace_back(part.file.parent_path() / name);
        const fs::path inside = fs::weakly_canonical(folder / name).lexically_relative(folder);
        if (!outside && (inside.empty() || *inside.begin() == ".."))
            refuse_merge("{} would write {}, outside of its folder; --outside lets it",
                         part.file.string(), output.string());
    }
    return outputs;
}

}  // namespace voxelume::cli
