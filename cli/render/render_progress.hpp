// SPDX-License-Identifier: Apache-2.0
// What `render` tells while it works: a bar, lines for logs, or JSON for programs.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "cli/render/time_left.hpp"
#include "cli/shared/progress.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// How progress is told: a bar where a person watches and lines about written frames elsewhere; a
/// bar; lines of text; a JSON object a line; or not at all.
enum class ProgressStyle { automatic, bar, plain, json, none };

/// The style that an option's text names, or a setting's. Throws Error::usage with its origin.
ProgressStyle progress_style(const std::string& text);

/// Tells how one job gets on. Any thread may call it.
class RenderProgress {
  public:
    /// `label` is the job's, such as "2 of 5".
    RenderProgress(std::string label, size_t frames, ProgressStyle style);

    /// `done` of all frames together, from 0 to 1, and the frame that got on.
    void advance(double done, int frame);
    /// The `kernel`-th of `known` kernels is being compiled.
    void compiling(int kernel, int known);
    /// A frame's files are written.
    void written(const FrameFiles& files);
    /// Makes room for a line of text.
    void clear();

  private:
    double seconds() const;
    bool is_due(double now, double interval);
    void print_plain(double done);
    void print_json(double done, int frame);

    ProgressStyle style_;
    std::string label_;
    size_t frames_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
    std::mutex mutex_;
    std::unique_ptr<Progress> bar_;  ///< of a bar's styles
    TimeLeft left_;
    uint64_t shown_ = 0;  ///< per cent of frames
    double told_ = -1e9;  ///< seconds, when the last line was printed
};

}  // namespace voxelume::cli
