// SPDX-License-Identifier: Apache-2.0
// `render --quilt` and `--stereo`: the views for a light-field display, and for two eyes.
#pragma once

#include <chrono>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

#include "runtime/voxelume.hpp"

// NOLINTNEXTLINE(readability-identifier-naming): the library's own name
namespace CLI {
class App;
}

namespace voxelume::cli {

class LazyDevices;
struct RenderCommand;

/// The options of quilts and stereo pairs.
struct QuiltChoices {
    std::string views;           ///< COLUMNSxROWS of a quilt; empty: no quilt
    std::optional<double> cone;  ///< degrees
    double focus = 0;            ///< metres; 0: at the point that the observer looks at
    double stereo = 0;           ///< metres between the eyes of a stereo pair; 0: no pair

    bool is_asked_for() const { return !views.empty() || stereo > 0; }
};

void add_quilt_options(CLI::App& app, QuiltChoices& choices);

/// The placeholder for "left" and "right" in the names of a stereo pair's files.
inline constexpr const char* kEye = "{eye}";

/// The files of the left and the right eye of a stereo pair; or the file itself if its name has no
/// `kEye` or no pair is asked for.
std::vector<std::filesystem::path> files_of_eyes(const std::filesystem::path& file,
                                                 const QuiltChoices& choices);

/// Renders a quilt or a stereo pair for each of the job's frames, and writes its files: quilts
/// under names that describe them; pairs side by side or, where a name has `kEye`, one file per
/// eye. Throws Error::usage for options that are impossible with them.
///
/// `start` is when the job began, for its statistics.
void render_quilts(const RenderCommand& command, const Scene& scene, const FrameJob& job,
                   LazyDevices& devices, const std::string& label,
                   std::chrono::steady_clock::time_point start);

}  // namespace voxelume::cli
