// What the command line of `render` asks for: which frames, and their files.
#pragma once

#include <string>
#include <vector>

#include "cli/scene_options.hpp"

namespace voxelume::cli {

struct RenderOptions {
    SceneOptions scene;
    std::vector<std::string> outputs, volumes;
    std::string frames;
    float exposure = 0;
    bool float_color = false;
    std::string channels = "RGBA,Z,P,N,objectId";
    std::string stats;
    bool plan_only = false;
    bool one_by_one = false;
    bool verbose = false;
    bool quiet = false;
};

/// A frame and the files that show it.
struct FrameFiles {
    int frame = 1;
    std::vector<std::string> images, volumes;
};

/// What is to be rendered: a frame each, or one for all where the world stands still. The frames
/// are those of --frames, or else all of a moving scene, or one.
std::vector<FrameFiles> frame_files(const RenderOptions& options, const Scene& scene);

std::vector<int> numbers_of(const std::vector<FrameFiles>& list);

/// What can be said before the scene is read: that --frames are none, that a disk can't take the
/// image. All frames of a pattern are in one folder, so the first ones stand for all. Throws
/// Error::usage and Error::output.
void check_options(const RenderOptions& options);

/// Refuses volumes of the wrong kind, and files that would be written over one another. Throws
/// Error::usage and as check_volume_output does.
void check_files(const std::vector<FrameFiles>& list, const Scene& scene,
                 const RenderOptions& options);

}  // namespace voxelume::cli
