// SPDX-License-Identifier: Apache-2.0
#include "cli/files/diff_findings.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <utility>
#include <vector>

namespace voxelume::cli {
namespace {

Report row_of(const ChannelDifference& c) {
    return {{"channel", c.channel},     {"max", c.max},
            {"rmse", c.rmse},           {"mae", c.mae},
            {"mrse", c.mrse},           {"differing", c.differing},
            {"unmatched", c.unmatched}, {"above", c.above}};
}

void add_whole(const ImageDifference& difference, Report& report) {
    if (difference.flip) report["FLIP"] = *difference.flip;
    report["pixels"] = difference.pixels;
    report["above"] = difference.above;
    if (!difference.only_in_a.empty()) report["only in A"] = difference.only_in_a;
    if (!difference.only_in_b.empty()) report["only in B"] = difference.only_in_b;
}

Report report_of(const ImageDifference& difference) {
    Report report;
    report["channels"] = Report::array();
    for (const ChannelDifference& c : difference.channels) report["channels"].push_back(row_of(c));
    add_whole(difference, report);
    return report;
}

/// A row of an animation's table: the channel with the largest RMSE stands for all, where there is
/// no error one with unequal ids, the one with most values that aren't finite for those, and
/// `missing` are channels of one image alone.
Report frame_row(int frame, const ImageDifference& difference) {
    const std::vector<ChannelDifference>& channels = difference.channels;
    const auto worst = std::ranges::max_element(channels, {}, [](const ChannelDifference& c) {
        return std::pair(c.rmse, c.is_id ? c.differing : 0);
    });
    Report missing = difference.only_in_a;
    for (const std::string& channel : difference.only_in_b) missing.push_back(channel);
    return {{"frame", frame},
            {"worst", worst->channel},
            {"max", worst->max},
            {"rmse", worst->rmse},
            {"FLIP", difference.flip ? Report(*difference.flip) : Report()},
            {"above", difference.above},
            {"unmatched", std::ranges::max(channels, {}, &ChannelDifference::unmatched).unmatched},
            {"missing", missing.empty() ? Report() : missing}};
}

/// What a frame's JSON has: its row, and all that is known of it as an image.
Report whole_frame(int frame, const ImageDifference& difference) {
    Report report = frame_row(frame, difference);
    report.update(report_of(difference));
    return report;
}

}  // namespace

void DiffFindings::add(const DiffFiles& files, const ImageDifference& difference) {
    if (is_animation_)
        report_["frames"].push_back(as_json_ ? whole_frame(files.frame, difference)
                                             : frame_row(files.frame, difference));
    else
        report_ = report_of(difference);
    if (excess_) return;
    excess_ = excess_of(difference, limits_);
    if (excess_ && is_animation_) excess_ = fmt::format("frame {}: {}", files.frame, *excess_);
}

void DiffFindings::add_failure(const DiffFiles& files, const Error& error) {
    report_["not compared"].push_back(files.frame);
    if (!failure_) failure_ = error;
}

void DiffFindings::throw_faults() const {
    const std::string excess = excess_ ? "the images differ: " + *excess_ : std::string();
    if (!failure_) {
        if (!excess.empty()) throw Error(ErrorKind::render, excess);
        return;
    }
    const size_t count = report_["not compared"].size();
    std::string text = failure_->what();
    if (count > 1) text += fmt::format("; {} frames can't be compared", count);
    if (!excess.empty()) text += "; " + excess;
    throw Error(failure_->kind(), text);
}

}  // namespace voxelume::cli
