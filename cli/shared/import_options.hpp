// SPDX-License-Identifier: Apache-2.0
// The options that commands have for model files in place of scenes: from where, on what ground.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

struct ImportChoices {
    std::string view, background, up, clip, spacing;  ///< empty: not given
    std::optional<double> angle, fit;
    std::optional<bool> ground;
    bool transparent = false;  ///< of scenes, too
};

/// What the names of model files end with, for people.
std::string model_endings();

/// The names that --view knows.
std::vector<std::string> view_names();

void add_import_options(CLI::App& app, ImportChoices& choices);

/// The choices for a model file, whose picture has the size, or a default where that is 0. Throws
/// Error::usage; `command` opens the message.
ImportOptions options_of(const ImportChoices& choices, Size size, const char* command);

/// Throws Error::usage if some choice was made: a scene has its own.
void refuse_choices(const ImportChoices& choices, const char* command);

}  // namespace voxelume::cli
