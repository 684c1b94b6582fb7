// SPDX-License-Identifier: Apache-2.0
// What the command line of `bench` asks for.
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
    SceneOptions scene;                   ///< assets and changes of own scenes
    std::vector<std::string> own_scenes;  ///< files
    std::vector<std::string> resolutions, placements, samples;  ///< with commas
    std::string size;
    int repeats = 0;  ///< 0: as --quick says
    std::string device;
    bool quiet = false;
};

/// The options of the measurement. Reads own scenes. Throws Error::usage for a scene that there
/// isn't, and Error as reading does.
BenchOptions options_of(const BenchCommand& command);

/// Refuses options that leave no row, or none of a scene that was asked for.
void check_rows(const BenchCommand& command, const BenchOptions& options);

}  // namespace voxelume::cli
