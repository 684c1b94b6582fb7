// SPDX-License-Identifier: Apache-2.0
#include "cli/finished_files.hpp"

#include <array>
#include <filesystem>

#include "cli/checks.hpp"

namespace voxelume::cli {

Overwrite overwrite_of(const RenderCommand& command) {
    constexpr std::array kWords = {std::pair{std::string_view("always"), Overwrite::always},
                                   std::pair{std::string_view("never"), Overwrite::never},
                                   std::pair{std::string_view("changed"), Overwrite::changed}};
    if (command.overwrite.empty()) return command.resume ? Overwrite::changed : Overwrite::always;
    const Overwrite overwrite = choose(command.overwrite, kWords, "render: --overwrite");
    if (command.resume && overwrite != Overwrite::changed)
        fail_usage("render: --resume and --overwrite {} ask for different things; leave one out",
                   command.overwrite);
    if (overwrite == Overwrite::never && !command.shard.empty())
        fail_usage(
            "render: --overwrite never keeps files of other runs, of which --shard can't tell "
            "`merge`; give --resume, which keeps those that are right");
    return overwrite;
}

size_t skip_finished(const Scene& scene, const ImageFileOptions& options, Overwrite overwrite,
                     std::vector<FrameFiles>& frames) {
    if (overwrite == Overwrite::always) return 0;
    std::vector<std::string> hashes;
    if (overwrite == Overwrite::changed) hashes = frame_hashes(scene, numbers_of(frames));
    size_t skipped = 0;
    std::vector<FrameFiles> left;
    for (size_t i = 0; i < frames.size(); ++i) {
        const auto is_finished = [&](const auto& check) {
            return [&](const std::filesystem::path& file) {
                std::error_code error;
                if (overwrite == Overwrite::never) return std::filesystem::exists(file, error);
                return check(file) == FrameFileState::current;
            };
        };
        const auto check_image = [&](const auto& file) {
            return image_file_state(file, hashes[i], options);
        };
        const auto check_volume = [&](const auto& file) {
            return volume_file_state(file, hashes[i]);
        };
        FrameFiles& files = frames[i];
        const size_t before = files.images.size() + files.volumes.size();
        std::erase_if(files.images, is_finished(check_image));
        std::erase_if(files.volumes, is_finished(check_volume));
        if (before > 0 && files.images.empty() && files.volumes.empty())
            ++skipped;
        else
            left.push_back(std::move(files));
    }
    frames = std::move(left);
    return skipped;
}

}  // namespace voxelume::cli
