// SPDX-License-Identifier: Apache-2.0
// `render --quilt`: the views of a light-field display in one image.
#pragma once

#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

struct RenderCommand;

/// The options of a quilt; `views` is empty where none is asked for.
struct QuiltChoices {
    std::string views;  ///< COLUMNSxROWS
    double cone = 40;   ///< degrees
    double focus = 0;   ///< metres; 0: to what the observer looks at
};

void add_quilt_options(CLI::App& app, QuiltChoices& choices);

/// Renders a quilt of each of the job's frames, and writes its files under names that say what is
/// in them. Throws Error::usage for options that can't be had of quilts.
void render_quilts(const RenderCommand& command, const Scene& scene, const FrameJob& job,
                   const std::vector<Device>& devices, const std::string& label);

}  // namespace voxelume::cli
