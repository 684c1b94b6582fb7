// SPDX-License-Identifier: Apache-2.0
// The frames and files that the command line of `render` asks for.
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
    SceneOptions scene;  ///< its own input is the one of `inputs` that is being rendered
    std::vector<std::string> inputs;
    std::vector<std::string> sweeps;  ///< PATH=V1,V2
    int views = 0;                    ///< around the scene; 0: only the scene's own view
    std::vector<std::string> outputs, volumes;
    QuiltChoices quilt;
    std::string frames;
    std::string crop;   ///< X,Y,WIDTH,HEIGHT; empty: the whole image
    std::string shard;  ///< I/N; empty: the whole run
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
    std::string earlier;   ///< images with fewer samples, to which samples are added; empty: none
    std::string fallback;  ///< devices that replace the scene's if these fail; empty: none
};

/// Declares the options on `app`; returns that of --frames.
const CLI::Option* add_render_options(CLI::App& app, RenderCommand& command);

/// What is to be rendered: one entry for each frame, or one for all if the world stands still. The
/// frames are those of --frames; otherwise, all frames of a moving scene, or one.
std::vector<FrameFiles> frame_files(const RenderCommand& options, const Scene& scene);

std::vector<int> numbers_of(const std::vector<FrameFiles>& list);

/// Checks what can be checked before the scene is read, for example that --frames is valid and that
/// the image's files can be created. All frames of a pattern lie in one folder, so the first ones
/// represent all. Throws Error::usage and Error::output.
void check_options(const RenderCommand& options);

/// Refuses volumes of the wrong kind, and files that would overwrite one another. Throws
/// Error::usage, and the errors of check_volume_output.
void check_files(const std::vector<FrameFiles>& list, const Scene& scene,
                 const RenderCommand& options);

}  // namespace voxelume::cli
