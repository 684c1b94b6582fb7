// SPDX-License-Identifier: Apache-2.0
#include "cli/files/voxelize_frames.hpp"

#include <algorithm>

#include "cli/files/voxelize_file.hpp"
#include "cli/files/voxelize_names.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/numbered_files.hpp"

namespace voxelume::cli {
namespace {

/// The frames of one scene that moves.
std::vector<VoxelizeNames> moving_frames(const VoxelizeCommand& command) {
    if (is_mesh_input(command.file, true))
        fail_usage(
            "voxelize: {}: a mesh is one frame: leave out {}, or name files of frames, as "
            "#### does for 0001",
            command.file, command.frames.empty() ? "the #### of the output" : "--frames");
    if (command.file == "-")
        fail_usage("voxelize: -: frames are of a scene in a file; --frame chooses one of a stream");
    return names_of_frames({command.file, command.outputs}, command.frames,
                           scene_in(command).frames());
}

std::vector<VoxelizeNames> frames_of(const VoxelizeCommand& command) {
    if (!is_file_sequence(command.file)) return moving_frames(command);
    if (!command.without.empty()) fail_usage("voxelize: --without is for objects of scenes");
    if (command.frame > 0)
        fail_usage("voxelize: --frame is of one file: --frames chooses among numbered ones");
    std::vector<std::string> gaps;
    std::vector<VoxelizeNames> frames =
        names_of_files({command.file, command.outputs}, command.frames, gaps);
    if (!gaps.empty())
        tell_notes(command, {fmt::format("the numbers have {} gap{}; the first begins at {}",
                                         gaps.size(), gaps.size() == 1 ? "" : "s", gaps.front())});
    return frames;
}

/// Takes the size of the voxels that the first frame's resolution gives. Those of a given size lie
/// as the world's do, so the first frame is made again with it.
void take_size(VoxelizeCommand& command) {
    VoxelizeCommand first = command;
    first.quiet = true;
    command.voxel_size = voxelize_file(first);
    if (command.voxel_size > 0) command.resolution = 0;
}

}  // namespace

bool has_frames(const VoxelizeCommand& command) {
    return is_file_sequence(command.file) || !command.frames.empty() ||
           std::ranges::any_of(command.outputs, is_numbered);
}

void voxelize_frames(VoxelizeCommand command) {
    const std::vector<VoxelizeNames> frames = frames_of(command);
    const bool is_moving = !is_file_sequence(command.file);
    for (size_t i = 0; i < frames.size(); ++i) {
        command.file = frames[i].file;
        command.outputs = frames[i].outputs;
        if (is_moving) command.frame = frames[i].frame;
        if (i == 0 && frames.size() > 1 && command.voxel_size == 0) take_size(command);
        voxelize_file(command);
    }
}

}  // namespace voxelume::cli
