#include "cli/frame_files.hpp"

#include <algorithm>
#include <filesystem>
#include <numeric>

#include "cli/checks.hpp"
#include "runtime/base/frame_list.hpp"
#include "runtime/base/frame_path.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/scene_file/scene_animation.hpp"
#include "runtime/stages/display/display_frame.hpp"

namespace voxelume::cli {
namespace {

bool is_pattern(const std::string& path) {
    return frame_path(path, 1, false) != path;
}

/// Whether an output without --frames asks for the whole animation: a name with #### does, but for
/// slices, whose #### is left to their writer.
bool wants_all_frames(const RenderOptions& options) {
    return std::ranges::any_of(options.outputs, is_pattern) ||
           std::ranges::any_of(options.volumes, [](const std::string& path) {
               return is_pattern(path) && std::filesystem::path(path).extension() != ".png";
           });
}

/// The frames of --frames, or else all of a moving scene, or one.
std::vector<int> frames_of(const RenderOptions& options, const Scene& scene) {
    if (!options.frames.empty()) return parse_frame_list(options.frames);
    const bool all = moves(scene) && (wants_all_frames(options) || options.plan_only);
    std::vector<int> frames(all ? size_t(scene.animation.frames) : 1);
    std::iota(frames.begin(), frames.end(), 1);
    return frames;
}

}  // namespace

std::vector<FrameFiles> frame_files(const RenderOptions& options, const Scene& scene) {
    const std::vector<int> frames = frames_of(options, scene);
    const bool animation = !options.frames.empty() || frames.size() > 1;
    std::vector<FrameFiles> list;
    for (const int frame : frames) {
        if (list.empty() || moves(scene)) list.push_back({frame, {}, {}});
        for (const std::string& pattern : options.outputs)
            list.back().images.push_back(frame_path(pattern, frame, animation));
        for (const std::string& pattern : options.volumes)
            list.back().volumes.push_back(animation ? frame_path(pattern, frame, true) : pattern);
    }
    return list;
}

std::vector<int> numbers_of(const std::vector<FrameFiles>& list) {
    std::vector<int> numbers;
    numbers.reserve(list.size());
    for (const FrameFiles& files : list) numbers.push_back(files.frame);
    return numbers;
}

void check_options(const RenderOptions& options) {
    if (options.outputs.empty() && options.volumes.empty() && !options.plan_only)
        throw Error(ErrorKind::usage,
                    "render: say where the image goes: -o image.exr, or --volume image.vdb");
    const bool animation = !options.frames.empty();
    const int first = animation ? parse_frame_list(options.frames).front() : 1;
    for (const std::string& pattern : options.outputs)
        check_output(frame_path(pattern, first, animation), {".exr", ".png"}, "render");
    if (!options.stats.empty()) check_output(options.stats, {}, "render");
}

void check_files(const std::vector<FrameFiles>& list, const Scene& scene,
                 const RenderOptions& options) {
    std::vector<std::string> names{options.stats};
    for (const FrameFiles& files : list) {
        names.insert(names.end(), files.images.begin(), files.images.end());
        names.insert(names.end(), files.volumes.begin(), files.volumes.end());
        for (const std::string& path : files.volumes)
            check_volume_output(path, display_frame(scene));
    }
    check_distinct(names, "render");
}

}  // namespace voxelume::cli
