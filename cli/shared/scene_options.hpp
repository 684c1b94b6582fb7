// SPDX-License-Identifier: Apache-2.0
// The options that every command on a scene has: which scene, on what device, how large an image.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "cli/shared/import_options.hpp"
#include "runtime/voxelume.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

struct SceneOptions {
    std::string scene;
    std::vector<std::filesystem::path> assets;
    std::string size;
    int samples = 0;    ///< 0: the scene's
    double noise = 0;   ///< 0: none is asked for
    double time = 0;    ///< seconds; 0: any
    std::string light;  ///< empty: the scene's
    std::string device;
    double device_timeout = 0;  ///< seconds; 0: none
    std::string memory_limit;   ///< "2.5GB"; empty: none
    bool no_cache = false;
    bool strict = false;
    std::vector<std::string> settings;  ///< PATH=VALUE, of --set
    std::vector<std::string> swept;     ///< likewise, of --sweep
    bool has_views = false;             ///< true if it is seen from all around
    double orbit = 0;                   ///< degrees of this view
    ImportChoices import;               ///< where the scene is a model file
};

/// Declares the options, but not the scene itself.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// From now on the program ends with a sentence when the device doesn't answer within
/// --device-timeout, and takes at most --memory-limit. Throws Error::usage for texts that are no
/// sizes; `command` opens the message.
void set_limits(const SceneOptions& options, const char* command);

/// Reads "PATH=VALUE". Throws Error::usage; `command` and `option` open messages.
SceneChange setting_of(const std::string& text, const char* option, const char* command);

/// The scene of a file, or from standard input for `-`.
Scene load_scene(const std::string& name, const v1::SceneOptions& options);

/// The scene with the options applied. `command` opens the messages about options.
Scene read_with(const SceneOptions& options, const char* command);

/// The user's cache of models, unless --no-cache was given.
CacheOptions cache_options(const SceneOptions& options);

/// How a plan is printed.
struct PlanPrint {
    bool as_json = false;
    bool quiet = false;         ///< without warnings, but for those in JSON
    bool strict = false;        ///< warnings are errors
    bool tells_volume = false;  ///< also of a volumetric image that isn't asked for
};

/// Says what a scene holds and what rendering takes on a device, on stdout, of the frames the one
/// that takes the most, and whether all fit; and its warnings on stderr.
///
/// Throws Error::limit when one doesn't, after saying why, and Error::scene for warnings if they
/// are errors.
void print_plan(const Scene& scene, const Device& device, const PlanOptions& options,
                const PlanPrint& print);

}  // namespace voxelume::cli
