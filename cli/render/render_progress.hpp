// SPDX-License-Identifier: Apache-2.0
// What `render` shows while it works: a bar, lines for logs, or JSON for programs.
#pragma once

#include <memory>
#include <mutex>
#include <string>

#include "cli/render/time_left.hpp"
#include "cli/shared/progress.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {

/// How progress is shown: automatic (a bar where a person watches, and lines about written frames
/// elsewhere), a bar, lines of text, one JSON object per line, or not at all.
enum class ProgressStyle { automatic, bar, plain, json, none };

/// The style that the text of an option or a setting names. Throws Error::usage with the text's
/// origin.
ProgressStyle progress_style(const std::string& text);

/// Shows the progress of one job. Any thread may call it.
class RenderProgress {
  public:
    /// `label` describes the job, such as "2 of 5".
    RenderProgress(std::string label, size_t frames, ProgressStyle style);

    /// `done` of all frames together is done, from 0 to 1; `frame` has made progress.
    void advance(double done, int frame);
    /// The `kernel`-th of `known` kernels is being compiled.
    void compiling(int kernel, int known);
    /// A frame's files have been written.
    void written(const FrameFiles& files);
    /// Clears the bar to make room for a line of text.
    void clear();
    /// Says how long kernels were compiled, if that took a second or more: logs have no bar that
    /// shows it meanwhile.
    void tell_of_compiling();

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
    std::unique_ptr<Progress> bar_;  ///< only in styles with a bar
    TimeLeft left_;
    int compiled_ = 0;    ///< kernels
    uint64_t shown_ = 0;  ///< percentage of the frames
    double told_ = -1e9;  ///< time when the last line was printed, seconds
};

}  // namespace voxelume::cli
