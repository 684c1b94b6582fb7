// SPDX-License-Identifier: Apache-2.0
// The progress bar, which is drawn only where a person watches.
#pragma once

#include <chrono>
#include <cstdint>
#include <cstdio>
#include <functional>
#include <mutex>
#include <optional>
#include <string>

namespace voxelume {

/// What decides whether and how a bar is drawn, independent of the process's streams.
struct Terminal {
    bool draws_bars = false;  ///< a terminal, TERM neither missing nor "dumb", no CI
    bool has_color = false;   ///< it draws bars, and NO_COLOR is unset or empty
    int columns = 80;
};

/// Looks up an environment variable; null when it isn't set.
using Variables = std::function<const char*(const char*)>;

/// The rule itself.
Terminal describe_terminal(bool is_terminal, const Variables& environment);

/// The rule, applied to a stream of this process with its actual width.
Terminal describe_terminal(std::FILE* stream);

/// What a bar shows.
struct ProgressState {
    std::string label;
    uint64_t done = 0;
    uint64_t total = 0;               ///< 0: nothing to do, shown as complete
    double seconds = 0.0;             ///< since the start
    std::optional<double> left = {};  ///< seconds, if known
};

/// Formats a time as "1:30", or as "1:00:00" from an hour on.
std::string clock_text(double seconds);

/// One line without a line end, never wider than the terminal: label, bar, percentage, time passed
/// or left.
std::string progress_line(const ProgressState& state, const Terminal& terminal);

/// The cases in which a bar is drawn.
enum class Drawing { never, where_watched, always };

/// Redraws a line on `stream` at most ten times a second; silent where no bar is to be drawn. Any
/// thread may call it.
class Progress {
  public:
    Progress(std::string label, uint64_t total, std::FILE* stream,
             Drawing drawing = Drawing::where_watched);
    /// Clears the line, so that what is printed next starts in a clean one.
    ~Progress();
    Progress(const Progress&) = delete;
    Progress& operator=(const Progress&) = delete;

    void advance(uint64_t count = 1);
    /// Sets the time left that is shown from now on. Without a call, it is extrapolated from the
    /// time passed.
    void foretell(std::optional<double> seconds);
    /// Shows a text instead of the bar until there is progress, once a second has passed without
    /// progress.
    void say(const std::string& text);
    /// Clears the line; it is drawn again when there is progress.
    void clear();

  private:
    using Clock = std::chrono::steady_clock;

    ProgressState state_;
    std::mutex mutex_;
    std::FILE* stream_;
    Terminal terminal_;
    Clock::time_point start_ = Clock::now();
    Clock::time_point drawn_{};
    bool is_foretold_ = false;
    Clock::time_point moved_{};  ///< when the bar was last drawn
};

}  // namespace voxelume
