// SPDX-License-Identifier: Apache-2.0
#include "cli/render/finished_files.hpp"

#include <array>
#include <filesystem>

#include "cli/shared/checks.hpp"
#include "cli/shared/tell.hpp"

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

namespace {

/// True if all files of a volume exist. Throws Error::output if only some exist: these may be
/// another program's, and must not be replaced.
bool is_kept(const std::filesystem::path& volume) {
    if (!volume_files(volume).empty()) return true;
    const std::vector<std::filesystem::path> others = replaced_files(volume);
    if (others.empty()) return false;
    throw Error(ErrorKind::output,
                fmt::format("{} is there already, but not all files of {}: --overwrite never "
                            "leaves it as it is; move it away, or render without the option",
                            others.front().string(), volume.string()));
}

/// True if a file in this state needs no rendering. Other files are counted.
bool is_current(FrameFileState state, Finished& finished) {
    finished.damaged += size_t(state == FrameFileState::damaged);
    finished.changed += size_t(state == FrameFileState::stale);
    return state == FrameFileState::current;
}

}  // namespace

bool is_finished(const std::filesystem::path& image, const std::string& hash,
                 const ImageFileOptions& options, Overwrite overwrite, Finished& finished) {
    std::error_code error;
    if (overwrite == Overwrite::always) return false;
    if (overwrite == Overwrite::never) return std::filesystem::exists(image, error);
    return is_current(image_file_state(image, hash, options), finished);
}

void tell_of(const Finished& finished, size_t count) {
    if (finished.frames > 0) tell("{} of {} frames are there already\n", finished.frames, count);
    const auto again = [](size_t files, const char* one, const char* several) {
        if (files > 0) tell("{} {}, and rendered again\n", files, files == 1 ? one : several);
    };
    again(finished.damaged, "file is damaged or has no hash in it",
          "files are damaged or have no hash in them");
    again(finished.changed, "file is of another scene, file, option or version",
          "files are of another scene, file, option or version");
}

Finished skip_finished(const Scene& scene, const ImageFileOptions& options, Overwrite overwrite,
                       std::vector<FrameFiles>& frames) {
    Finished finished;
    if (overwrite == Overwrite::always) return finished;
    const std::vector<int> numbers = numbers_of(frames);
    std::vector<std::string> hashes, of_volumes;
    if (overwrite == Overwrite::changed) {
        hashes = frame_hashes(scene, numbers);
        of_volumes = volume_hashes(scene, numbers);
    }
    std::vector<FrameFiles> left;
    for (size_t i = 0; i < frames.size(); ++i) {
        const auto has_image = [&](const std::filesystem::path& file) {
            return is_finished(file, hashes.empty() ? "" : hashes[i], options, overwrite, finished);
        };
        const auto has_volume = [&](const std::filesystem::path& file) {
            return overwrite == Overwrite::never
                       ? is_kept(file)
                       : is_current(volume_file_state(file, of_volumes[i]), finished);
        };
        FrameFiles& files = frames[i];
        const size_t before = files.images.size() + files.volumes.size();
        std::erase_if(files.images, has_image);
        std::erase_if(files.volumes, has_volume);
        if (before > 0 && files.images.empty() && files.volumes.empty())
            ++finished.frames;
        else
            left.push_back(std::move(files));
    }
    frames = std::move(left);
    return finished;
}

}  // namespace voxelume::cli
