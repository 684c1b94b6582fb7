// SPDX-License-Identifier: Apache-2.0
// The options of every command on a scene: which scene, on what device, how large an image.
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
    int samples = 0;    ///< 0: as in the scene
    double noise = 0;   ///< 0: no noise is asked for
    double time = 0;    ///< seconds; 0: not limited
    std::string light;  ///< empty: as in the scene
    std::string device;
    double device_timeout = 0;  ///< seconds; 0: none
    std::string memory_limit;   ///< "2.5GB"; empty: none
    bool no_cache = false;
    bool strict = false;
    std::vector<std::string> settings;  ///< PATH=VALUE texts of --set
    std::vector<std::string> swept;     ///< PATH=V1,V2 texts of --sweep
    bool has_views = false;             ///< true if the scene is seen from all around
    double orbit = 0;                   ///< degrees of this view
    ImportChoices import;               ///< for a scene that is a model file
};

/// Declares the options, except the scene itself.
void add_scene_options(CLI::App& app, SceneOptions& options);

/// Sets the limits of the options for the rest of the program: it ends with a message if the device
/// doesn't answer within --device-timeout, and uses at most --memory-limit. Throws Error::usage for
/// texts that are no sizes; `command` opens the message.
void set_limits(const SceneOptions& options, const char* command);

/// Reads "PATH=VALUE". Throws Error::usage; `command` and `option` open the message.
SceneChange setting_of(const std::string& text, const char* option, const char* command);

/// Loads the scene of a file, or from standard input for `-`.
Scene load_scene(const std::string& name, const v1::SceneOptions& options);

/// Loads the scene and applies the options. `command` opens messages about options.
Scene read_with(const SceneOptions& options, const char* command);

/// The user's cache of models, unless --no-cache was given.
CacheOptions cache_options(const SceneOptions& options);

/// How a plan is printed.
struct PlanPrint {
    bool as_json = false;
    bool quiet = false;         ///< omits warnings, except for those in JSON
    bool strict = false;        ///< warnings are errors
    bool tells_volume = false;  ///< also describes a volumetric image that isn't asked for
};

/// Prints what a scene contains and what rendering it takes on a device to stdout: the needs of the
/// most expensive frame, and whether all frames fit. Prints its warnings to stderr.
///
/// Throws Error::limit, after saying why, if a frame doesn't fit, and Error::scene for warnings if
/// they are errors.
void print_plan(const Scene& scene, const std::string& selector, const PlanOptions& options,
                const PlanPrint& print);

}  // namespace voxelume::cli
