// SPDX-License-Identifier: Apache-2.0
// The options of `bench`.
#pragma once

#include <string>
#include <vector>

#include "cli/shared/scene_options.hpp"
#include "runtime/voxelume_verify.hpp"

namespace voxelume::cli {

struct BenchCommand {
    bool is_quick = false;
    std::string page, json, csv, plot, peers;
    std::vector<std::string> only;
    SceneOptions scene;                   ///< assets and changes for the user's own scenes
    std::vector<std::string> own_scenes;  ///< files
    std::vector<std::string> resolutions, placements, samples;  ///< lists with commas
    std::string size;
    int repeats = 0;  ///< 0: as --quick says
    std::string device;
    bool quiet = false;
};

/// The options of the measurement. Reads the user's own scenes. Throws Error::usage for a scene
/// that doesn't exist, and the errors of reading scenes.
BenchOptions options_of(const BenchCommand& command);

/// Refuses options that leave no row at all, or no row for a scene that was asked for.
void check_rows(const BenchCommand& command, const BenchOptions& options);

}  // namespace voxelume::cli
