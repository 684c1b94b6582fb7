// SPDX-License-Identifier: Apache-2.0
#include "cli/render/shard_part.hpp"

#include <fmt/format.h>
#include <xxhash.h>

#include <utility>

#include "cli/output/crop.hpp"
#include "cli/output/output_names.hpp"
#include "cli/output/output_stream.hpp"
#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

/// One hash for all frames of a run; with one frame, it is that frame's own hash.
std::string joint_hash(const std::vector<std::string>& hashes) {
    if (hashes.size() == 1) return hashes.front();
    const std::string text = fmt::format("{}", fmt::join(hashes, " "));
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

/// The manifest's path, made from the name of the first output in the options.
fs::path manifest_path(const RenderCommand& command, const Shard& shard) {
    const std::vector<std::string>& outputs =
        command.outputs.empty() ? command.volumes : command.outputs;
    return fmt::format("{}.{}-of-{}.shard", outputs.front(),
                       padded(size_t(shard.number), size_t(shard.count)), shard.count);
}

}  // namespace

ShardPart::ShardPart(const RenderCommand& command, Scene& scene, FrameJob& job) {
    manifest_.shard = parse_shard(command.shard);
    if (OutputStream(command.outputs).is_wanted())
        fail_usage("render: --shard writes files beside each other, and standard output has none");
    file_ = manifest_path(command, manifest_.shard);
    manifest_.frames = numbers_of(job.frames);
    manifest_.options = job.image_files;
    manifest_.scene = joint_hash(frame_hashes(scene, manifest_.frames));
    // Names have no folders, and `merge` looks for them without: parts may be moved to other
    // folders.
    for (const auto* files : {&command.outputs, &command.volumes})
        for (const std::string& file : *files) manifest_.outputs.push_back(name_of(file));
    if (job.frames.size() == 1)
        cut_image(command, scene, job);
    else
        job.frames = frames_ = frames_of(manifest_.shard, job.frames);
}

void ShardPart::cut_image(const RenderCommand& command, Scene& scene, FrameJob& job) {
    FrameFiles& frame = job.frames.front();
    if (!frame.volumes.empty())
        fail_usage(
            "render: --shard cuts images, and frames of animations, but no volumetric image "
            "of one frame: leave --volume out");
    const ImagePart whole = part_of(command.crop, scene);
    const auto [first, end] = rows_of(manifest_.shard, whole.size[1]);
    ShardRows rows{first, end, whole.size[1], {}, manifest_.scene, {}};
    for (const fs::path& file : frame.images) rows.outputs.push_back(name_of(file));
    rows_ = file_.string() + ".exr";
    job.image_files = {.float_color = true, .channels = needed_channels(job)};
    frame.images = {rows_};
    manifest_.rows = std::move(rows);
    if (first == end)
        job.frames.clear();
    else
        scene =
            scene.with_crop({whole.first[0], whole.first[1] + first}, {whole.size[0], end - first});
}

std::string ShardPart::name_of(const fs::path& file) const {
    const auto whole = [](const fs::path& path) { return fs::absolute(path).lexically_normal(); };
    std::string name = whole(file).lexically_relative(whole(file_).parent_path()).string();
    if (!is_text(name))
        fail_usage("render: --shard: the output's name isn't UTF-8, as a part's text has to be");
    return name;
}

ShardFile ShardPart::described(const fs::path& file) const {
    return {name_of(file), hash_of_file(file)};
}

void ShardPart::write() const {
    ShardManifest manifest = manifest_;
    for (const FrameFiles& frame : frames_) {
        ShardManifest::Frame& own = manifest.own.emplace_back();
        own.frame = frame.frame;
        for (const fs::path& file : frame.images) own.files.push_back(described(file));
        for (const fs::path& volume : frame.volumes)
            for (const fs::path& file : volume_files(volume)) own.files.push_back(described(file));
    }
    if (manifest.rows && manifest.rows->end > manifest.rows->first)
        manifest.rows->file = described(rows_);
    write_manifest(file_, manifest);
}

}  // namespace voxelume::cli
