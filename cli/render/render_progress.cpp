// SPDX-License-Identifier: Apache-2.0
#include "cli/render/render_progress.hpp"

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>
#include <string_view>

#include "cli/shared/checks.hpp"
#include "cli/shared/settings.hpp"
#include "cli/shared/tell.hpp"
#include "cli/shared/warnings.hpp"

namespace voxelume::cli {
namespace {

using Json = nlohmann::ordered_json;

constexpr double kPlainInterval = 5, kJsonInterval = 0.5;  // seconds

constexpr std::array kStyles = {std::pair{std::string_view("auto"), ProgressStyle::automatic},
                                std::pair{std::string_view("bar"), ProgressStyle::bar},
                                std::pair{std::string_view("plain"), ProgressStyle::plain},
                                std::pair{std::string_view("json"), ProgressStyle::json},
                                std::pair{std::string_view("none"), ProgressStyle::none}};

/// Rounds to milliseconds, which is what a program can use.
double rounded(double value) {
    return std::round(value * 1e3) / 1e3;
}

/// Prints a JSON line. Names of files may be in any encoding.
void print_line(const Json& object) {
    tell("{}\n", object.dump(-1, ' ', false, Json::error_handler_t::replace));
    std::fflush(stderr);
}

}  // namespace

ProgressStyle progress_style(const std::string& text) {
    std::string origin = "render: --progress";
    for (const SettingValue& value : loaded_settings())
        if (value.setting->name == std::string_view("progress") && !value.value.empty() &&
            value.value == text)
            origin = fmt::format("{}: progress", value.origin);
    return choose(text, kStyles, origin.c_str());
}

RenderProgress::RenderProgress(std::string label, size_t frames, ProgressStyle style)
    : style_(style),
      label_(std::move(label)),
      frames_(frames),
      left_(frames > 1 ? 1.0 / double(frames) : 0) {
    const bool is_bar = style == ProgressStyle::automatic || style == ProgressStyle::bar;
    if (is_bar)
        bar_ = std::make_unique<Progress>(
            label_, 100 * frames, stderr,
            style == ProgressStyle::bar ? Drawing::always : Drawing::where_watched);
}

double RenderProgress::seconds() const {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
}

bool RenderProgress::is_due(double now, double interval) {
    if (now - told_ < interval) return false;
    told_ = now;
    return true;
}

void RenderProgress::advance(double done, int frame) {
    const std::lock_guard lock(mutex_);
    const double now = seconds();
    left_.advance(now, done);
    if (bar_) {
        const auto per_cent = uint64_t(done * 100 * double(frames_));
        bar_->foretell(left_.seconds());
        bar_->advance(per_cent - shown_);
        shown_ = per_cent;
    } else if (style_ == ProgressStyle::plain && is_due(now, kPlainInterval)) {
        print_plain(done);
    } else if (style_ == ProgressStyle::json && (done >= 1 || is_due(now, kJsonInterval))) {
        print_json(done, frame);
    }
}

void RenderProgress::print_plain(double done) {
    const std::optional<double> left = left_.seconds();
    tell("{}: {:.0f} %{}\n", label_, std::floor(done * 100),
         left && done < 1 ? fmt::format(", {} left", clock_text(*left)) : "");
}

void RenderProgress::print_json(double done, int frame) {
    const std::optional<double> left = left_.seconds();
    Json line = {{"event", "progress"},
                 {"job", label_},
                 {"frame", frame},
                 {"done", rounded(done)},
                 {"seconds", rounded(seconds())},
                 {"compile_seconds", rounded(left_.compile_seconds())},
                 {"seconds_left", nullptr}};
    if (left) line["seconds_left"] = rounded(*left);
    print_line(line);
}

void RenderProgress::compiling(int kernel, int known) {
    const std::lock_guard lock(mutex_);
    const double now = seconds();
    left_.compiling(now);
    compiled_ = kernel;
    const double compiled = left_.compile_seconds(now);
    const std::string text =
        fmt::format("compiling kernels: {} of {}, {:.0f} s so far", kernel, known, compiled);
    if (bar_)
        bar_->say(text);
    else if (style_ == ProgressStyle::plain && is_due(now, kPlainInterval))
        tell("{}: {}\n", label_, text);
    else if (style_ == ProgressStyle::json)
        print_line({{"event", "compiling"},
                    {"job", label_},
                    {"kernel", kernel},
                    {"known", known},
                    {"compile_seconds", rounded(compiled)}});
}

void RenderProgress::written(const FrameFiles& files) {
    const bool is_json = style_ == ProgressStyle::json;
    const bool is_watched = style_ == ProgressStyle::bar || (style_ == ProgressStyle::automatic &&
                                                             describe_terminal(stderr).draws_bars);
    if (style_ == ProgressStyle::none || is_watched || (frames_ == 1 && !is_json)) return;
    const std::lock_guard lock(mutex_);
    for (const auto* paths : {&files.images, &files.volumes})
        for (const std::filesystem::path& path : *paths)
            if (is_json)
                print_line({{"event", "written"},
                            {"job", label_},
                            {"frame", files.frame},
                            {"file", path.string()}});
            else
                tell("frame {}: {}\n", files.frame, path.string());
}

void RenderProgress::tell_of_compiling() {
    const std::lock_guard lock(mutex_);
    const bool is_text = style_ != ProgressStyle::json && style_ != ProgressStyle::none;
    if (!is_text || left_.compile_seconds() < 1) return;
    tell("compiled {} in {:.1f} s, for other runs, too\n",
         compiled_ == 1 ? "a kernel" : fmt::format("{} kernels", compiled_),
         left_.compile_seconds());
}

void RenderProgress::clear() {
    if (bar_) bar_->clear();
}

}  // namespace voxelume::cli
