// SPDX-License-Identifier: Apache-2.0
#include "cli/files/diff_limits.hpp"

#include <CLI/CLI.hpp>
#include <algorithm>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

/// Checks an option's text: a number of pixels, or a percentage such as "0.5%".
std::string check_above(const std::string& text) {
    const bool is_share = text.ends_with('%');
    const std::string number = is_share ? text.substr(0, text.size() - 1) : text;
    return is_share ? in_range(0, 100)(number) : in_range(0, 1e18, Number::whole)(number);
}

/// The number of pixels above the threshold that `text` allows.
double allowed_pixels(const std::string& text, uint64_t pixels) {
    if (!text.ends_with('%')) return std::stod(text);
    return std::stod(text.substr(0, text.size() - 1)) / 100 * double(pixels);
}

std::string pixels(uint64_t count) {
    return fmt::format("{} pixel{}", count, count == 1 ? "" : "s");
}

std::optional<std::string> excess_of_channels(const ImageDifference& difference, double limit) {
    for (const ChannelDifference& c : difference.channels) {
        if (c.is_id) continue;
        if (c.unmatched > 0)
            return fmt::format("{} of {} {} where a value isn't finite", pixels(c.unmatched),
                               c.channel, c.unmatched == 1 ? "differs" : "differ");
        if (c.rmse > limit)
            return fmt::format("the RMSE of {} is {:.6g}, above {:.6g}", c.channel, c.rmse, limit);
    }
    return {};
}

/// Describes the channel with the most unequal ids, if there are too many.
std::optional<std::string> excess_of_ids(const ImageDifference& difference,
                                         const std::string& limit) {
    const auto unequal = [](const ChannelDifference& c) { return c.is_id ? c.differing : 0; };
    const auto worst = std::ranges::max_element(difference.channels, {}, unequal);
    if (worst == difference.channels.end()) return {};
    const uint64_t count = unequal(*worst);
    if (double(count) <= allowed_pixels(limit, difference.pixels)) return {};
    return fmt::format("{} of {} {} unequal ids, and {} may", pixels(count), worst->channel,
                       count == 1 ? "has" : "have", limit);
}

}  // namespace

void add_limit_options(CLI::App& app, DiffLimits& limits) {
    app.add_option("--fail", limits.rmse,
                   "exit with 1 if a channel's RMSE is above this, a value is finite in one image "
                   "only, ids are unequal (--fail-ids allows some), or a channel is missing")
        ->check(in_range(0, 1e30));
    app.add_option("--fail-above", limits.above,
                   "exit with 1 if more pixels than this are above --threshold in some channel, "
                   "ids among them, or a channel is missing; 0.1% is a part of all pixels")
        ->check(check_above)
        ->type_name("COUNT");
    app.add_option("--fail-ids", limits.ids,
                   "exit with 1 if more pixels than this of a channel of ids, such as objectId or "
                   "CryptoObject00.R, are unequal, or a channel is missing; 0.1% is a part of all "
                   "pixels")
        ->check(check_above)
        ->type_name("COUNT");
    app.add_option("--fail-flip", limits.flip, "exit with 1 if FLIP is above this")
        ->check(in_range(0, 1));
}

std::optional<std::string> excess_of(const ImageDifference& difference, const DiffLimits& limits) {
    if (limits.rmse)
        if (auto excess = excess_of_channels(difference, *limits.rmse)) return excess;
    if (limits.rmse || !limits.ids.empty())
        if (auto excess = excess_of_ids(difference, limits.ids.empty() ? "0" : limits.ids))
            return excess;
    if (!limits.above.empty() &&
        double(difference.above) > allowed_pixels(limits.above, difference.pixels))
        return fmt::format("{} of {} {} above the threshold, and {} may be", difference.above,
                           pixels(difference.pixels), difference.above == 1 ? "is" : "are",
                           limits.above);
    if (limits.flip && !difference.flip)
        return "FLIP can't be told: some pixels' colours aren't numbers, or memory has no room";
    if (limits.flip && *difference.flip > *limits.flip)
        return fmt::format("FLIP is {:.6g}, above {:.6g}", *difference.flip, *limits.flip);
    if (!limits.rmse && limits.above.empty() && limits.ids.empty()) return {};
    if (!difference.only_in_a.empty()) return "only A has channel " + difference.only_in_a.front();
    if (!difference.only_in_b.empty()) return "only B has channel " + difference.only_in_b.front();
    return {};
}

}  // namespace voxelume::cli
