// SPDX-License-Identifier: Apache-2.0
// The options for model files in place of scenes, such as the view, the background and the ground.
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
    bool transparent = false;  ///< for scenes, too
};

/// The endings of model files' names, for people.
std::string model_endings();

/// The names that --view accepts.
std::vector<std::string> view_names();

void add_import_options(CLI::App& app, ImportChoices& choices);

/// Turns the choices into options for a model file. The picture has the size `size`, or a default
/// where that is 0. Throws Error::usage; `command` opens the message.
ImportOptions options_of(const ImportChoices& choices, Size size, const char* command);

/// Throws Error::usage if any choice was made, because a scene has its own.
void refuse_choices(const ImportChoices& choices, const char* command);

}  // namespace voxelume::cli
