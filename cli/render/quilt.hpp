// SPDX-License-Identifier: Apache-2.0
// `render --quilt` and `--stereo`: the views of a light-field display, and of two eyes.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

struct RenderCommand;

/// The options of quilts and stereo pairs.
struct QuiltChoices {
    std::string views;  ///< COLUMNSxROWS of a quilt; empty where none is asked for
    double cone = 40;   ///< degrees
    double focus = 0;   ///< metres; 0: to what the observer looks at
    double stereo = 0;  ///< metres between the eyes of a stereo pair; 0: none is asked for

    bool is_asked_for() const { return !views.empty() || stereo > 0; }
};

void add_quilt_options(CLI::App& app, QuiltChoices& choices);

/// What stands for "left" and "right" in the names of a stereo pair's files.
inline constexpr const char* kEye = "{eye}";

/// The files of the left and of the right eye of a stereo pair, or the file itself where its name
/// has no `kEye` or no pair is asked for.
std::vector<std::filesystem::path> files_of_eyes(const std::filesystem::path& file,
                                                 const QuiltChoices& choices);

/// Renders a quilt or a stereo pair of each of the job's frames, and writes its files: quilts under
/// names that say what is in them, pairs side by side or, where a name has `kEye`, one by one.
/// Throws Error::usage for options that can't be had of them.
void render_quilts(const RenderCommand& command, const Scene& scene, const FrameJob& job,
                   const std::vector<Device>& devices, const std::string& label);

}  // namespace voxelume::cli
