// SPDX-License-Identifier: Apache-2.0
// One call of `render` -> its jobs: each input from each view with each combination of values.
#pragma once

#include <string>
#include <vector>

#include "cli/render/frame_files.hpp"

namespace voxelume::cli {

/// One scene to be rendered.
struct RenderJob {
    std::string name;       ///< for people: "a.vox, view 2, intensity=4"
    RenderCommand command;  ///< options of this job alone; outputs have no placeholders
};

/// The jobs of a command, in the order of its inputs, then views, then values.
///
/// Throws Error::usage for placeholders that don't exist, and if two jobs would write the same
/// file.
std::vector<RenderJob> render_jobs(const RenderCommand& command);

}  // namespace voxelume::cli
