// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/progress.hpp"

#include <fmt/format.h>
#include <sys/ioctl.h>
#include <unistd.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <string_view>
#include <utility>

namespace voxelume {

namespace {

bool is_set(const Variables& environment, const char* name) {
    const char* value = environment(name);
    return value != nullptr && *value != '\0';
}

/// The time passed at the end; before that, the time left.
std::string time_text(const ProgressState& state, double part) {
    if (part >= 1.0) return clock_text(state.seconds);
    return state.left ? clock_text(*state.left) + " left" : "";
}

constexpr std::string_view kClearLine = "\r\x1b[K";

}  // namespace

std::string clock_text(double seconds) {
    const auto whole = std::lround(std::min(seconds, 359999.0));
    if (whole < 3600) return fmt::format("{}:{:02}", whole / 60, whole % 60);
    return fmt::format("{}:{:02}:{:02}", whole / 3600, whole / 60 % 60, whole % 60);
}

Terminal describe_terminal(bool is_terminal, const Variables& environment) {
    const bool dumb =
        !is_set(environment, "TERM") || std::string_view(environment("TERM")) == "dumb";
    Terminal terminal;
    terminal.draws_bars = is_terminal && !dumb && !is_set(environment, "CI");
    terminal.has_color = terminal.draws_bars && !is_set(environment, "NO_COLOR");
    return terminal;
}

Terminal describe_terminal(std::FILE* stream) {
    const int descriptor = fileno(stream);
    Terminal terminal = describe_terminal(
        isatty(descriptor) == 1, [](const char* name) -> const char* { return std::getenv(name); });
    winsize size{};
    if (ioctl(descriptor, TIOCGWINSZ, &size) == 0 && size.ws_col > 0)
        terminal.columns = size.ws_col;
    return terminal;
}

std::string progress_line(const ProgressState& state, const Terminal& terminal) {
    const double part =
        state.total == 0
            ? 1.0
            : std::min(1.0, static_cast<double>(state.done) / static_cast<double>(state.total));
    // The percentage is rounded down, so that 100 % appears only when nothing is left.
    const std::string text = fmt::format("{:3}% {:<12}", static_cast<int>(std::floor(part * 100.0)),
                                         time_text(state, part));
    const int columns = std::max(0, terminal.columns - 1);
    const int room = columns - static_cast<int>(state.label.size() + text.size()) - 4;
    if (room < 5) return (state.label + " " + text).substr(0, static_cast<size_t>(columns));
    const int cells = std::min(room, 40);
    const int full = static_cast<int>(std::floor(part * cells));
    const std::string bar(static_cast<size_t>(full), '#');
    const std::string rest(static_cast<size_t>(cells - full), '-');
    const char* color = terminal.has_color ? "\x1b[32m" : "";
    const char* plain = terminal.has_color ? "\x1b[0m" : "";
    return fmt::format("{} [{}{}{}{}] {}", state.label, color, bar, plain, rest, text);
}

Progress::Progress(std::string label, uint64_t total, std::FILE* stream, Drawing drawing)
    : state_{std::move(label), 0, total, 0.0, {}}, stream_(stream) {
    if (drawing != Drawing::never) terminal_ = describe_terminal(stream);
    terminal_.draws_bars |= drawing == Drawing::always;
}

void Progress::foretell(std::optional<double> seconds) {
    const std::lock_guard lock(mutex_);
    is_foretold_ = true;
    state_.left = seconds;
}

Progress::~Progress() {
    clear();
}

void Progress::clear() {
    const std::lock_guard lock(mutex_);
    if (drawn_ == Clock::time_point{}) return;
    std::fwrite(kClearLine.data(), 1, kClearLine.size(), stream_);
    std::fflush(stream_);
}

void Progress::say(const std::string& text) {
    const std::lock_guard lock(mutex_);
    const Clock::time_point now = Clock::now();
    if (!terminal_.draws_bars || now - std::max(start_, moved_) < std::chrono::seconds(1)) return;
    drawn_ = now;
    const std::string line =
        fmt::format("{}{}", kClearLine,
                    text.substr(0, static_cast<size_t>(std::max(0, terminal_.columns - 1))));
    std::fwrite(line.data(), 1, line.size(), stream_);
    std::fflush(stream_);
}

void Progress::advance(uint64_t count) {
    const std::lock_guard lock(mutex_);
    state_.done += count;
    if (!terminal_.draws_bars) return;
    const Clock::time_point now = Clock::now();
    if (now - drawn_ < std::chrono::milliseconds(100) && state_.done < state_.total) return;
    drawn_ = moved_ = now;
    state_.seconds = std::chrono::duration<double>(now - start_).count();
    if (!is_foretold_ && state_.done > 0)
        state_.left = state_.seconds * (double(state_.total) / double(state_.done) - 1.0);
    const std::string line = fmt::format("\r{}", progress_line(state_, terminal_));
    std::fwrite(line.data(), 1, line.size(), stream_);
    std::fflush(stream_);
}

}  // namespace voxelume
