// SPDX-License-Identifier: Apache-2.0
// What the command line of `render` asks for: which frames, and their files.
#pragma once

#include <string>
#include <vector>

#include "cli/render/quilt.hpp"
#include "cli/shared/scene_options.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class Option;
}

namespace voxelume::cli {

struct RenderCommand {
    SceneOptions scene;  ///< whose own input is one of `inputs`, while that is rendered
    std::vector<std::string> inputs;
    std::vector<std::string> sweeps;  ///< PATH=V1,V2
    int views = 0;                    ///< around the scene; 0: the scene's own alone
    std::vector<std::string> outputs, volumes;
    QuiltChoices quilt;
    std::string frames;
    std::string crop;   ///< X,Y,WIDTH,HEIGHT; empty: all of the image
    std::string shard;  ///< I/N; empty: all of the run
    double exposure = 0;
    std::string view_transform = "srgb";
    int png_bits = 8;
    bool float_color = false;
    bool multi_part = false;
    std::string channels = "RGBA,Z,P,N,objectId";
    std::string stats;
    bool plan_only = false;
    bool one_by_one = false;
    bool verbose = false;
    bool quiet = false;
    std::string progress = "auto";
    std::string overwrite;  ///< empty: always
    bool resume = false;
    std::string earlier;   ///< images with fewer samples, which get others; empty: none
    std::string fallback;  ///< devices that take over where the scene's fail; empty: none
};

/// Declares the options on `app`; returns that of --frames.
const CLI::Option* add_render_options(CLI::App& app, RenderCommand& command);

/// What is to be rendered: a frame each, or one for all where the world stands still. The frames
/// are those of --frames, or else all of a moving scene, or one.
std::vector<FrameFiles> frame_files(const RenderCommand& options, const Scene& scene);

std::vector<int> numbers_of(const std::vector<FrameFiles>& list);

/// What can be said before the scene is read: that --frames are none, that a disk can't take the
/// image. All frames of a pattern are in one folder, so the first ones stand for all. Throws
/// Error::usage and Error::output.
void check_options(const RenderCommand& options);

/// Refuses volumes of the wrong kind, and files that would be written over one another. Throws
/// Error::usage and as check_volume_output does.
void check_files(const std::vector<FrameFiles>& list, const Scene& scene,
                 const RenderCommand& options);

}  // namespace voxelume::cli
