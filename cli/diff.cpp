// SPDX-License-Identifier: Apache-2.0
// voxelume diff A B: how far two images are from each other.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <optional>
#include <sstream>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/report.hpp"

namespace voxelume::cli {

namespace {

constexpr const char* kColors[] = {"R", "G", "B"};

struct DiffOptions {
    std::string a, b;
    std::string channels;  ///< names with commas between them; empty: all
    std::optional<double> fail;
    bool json = false;
};

/// Compares files; messages name them.
ImageDifference compare_files(const DiffOptions& options) {
    const Image a = Image::read(options.a), b = Image::read(options.b);
    if (a.holds_codes() != b.holds_codes())
        fail_usage("diff: {} and {} aren't of one kind: a PNG holds codes, an EXR light", options.a,
                   options.b);
    if (a.width() != b.width() || a.height() != b.height())
        throw Error(ErrorKind::render,
                    fmt::format("{} has {} x {} pixels and {} has {} x {}", options.a, a.width(),
                                a.height(), options.b, b.width(), b.height()));
    return compare(a, b);
}

/// Leaves the channels that were asked for, and FLIP where all colours are among them.
void select_channels(ImageDifference& difference, const std::string& list) {
    std::vector<std::string_view> known(difference.only_in_a.begin(), difference.only_in_a.end());
    known.insert(known.end(), difference.only_in_b.begin(), difference.only_in_b.end());
    for (const ChannelDifference& channel : difference.channels) known.push_back(channel.channel);
    std::vector<std::string> wanted;
    std::istringstream stream(list);
    for (std::string name; std::getline(stream, name, ',');) {
        if (std::find(known.begin(), known.end(), name) == known.end())
            fail_usage("diff: no channel named {}{}", quote(name), suggest(name, known));
        wanted.push_back(name);
    }
    const auto unwanted = [&](const std::string& name) {
        return std::find(wanted.begin(), wanted.end(), name) == wanted.end();
    };
    std::erase_if(difference.channels, [&](const auto& c) { return unwanted(c.channel); });
    std::erase_if(difference.only_in_a, unwanted);
    std::erase_if(difference.only_in_b, unwanted);
    if (std::ranges::any_of(kColors, unwanted)) difference.flip.reset();
}

Report make_report(const ImageDifference& difference) {
    Report report;
    report["channels"] = Report::array();
    for (const ChannelDifference& c : difference.channels)
        report["channels"].push_back({{"channel", c.channel},
                                      {"max", c.max},
                                      {"rmse", c.rmse},
                                      {"mae", c.mae},
                                      {"mrse", c.mrse},
                                      {"differing", c.differing},
                                      {"unmatched", c.unmatched}});
    if (difference.flip) report["FLIP"] = *difference.flip;
    if (!difference.only_in_a.empty()) report["only in A"] = difference.only_in_a;
    if (!difference.only_in_b.empty()) report["only in B"] = difference.only_in_b;
    return report;
}

void check_limit(const ImageDifference& difference, double limit) {
    const auto fail = [](const std::string& reason) {
        throw Error(ErrorKind::render, "the images differ: " + reason);
    };
    for (const ChannelDifference& c : difference.channels) {
        if (c.unmatched > 0)
            fail(fmt::format("{} pixels of {} are finite in one only", c.unmatched, c.channel));
        if (c.rmse > limit)
            fail(fmt::format("the RMSE of {} is {:.6g}, above {:.6g}", c.channel, c.rmse, limit));
    }
    if (!difference.only_in_a.empty()) fail("only A has channel " + difference.only_in_a.front());
    if (!difference.only_in_b.empty()) fail("only B has channel " + difference.only_in_b.front());
}

}  // namespace

Action add_diff(CLI::App& app) {
    auto options = std::make_shared<DiffOptions>();
    app.add_option("A", options->a, "image to judge, OpenEXR or PNG")->required();
    app.add_option("B", options->b, "reference image, of the same kind and size")->required();
    app.add_option("--channels", options->channels, "compare only these channels, like R,G,B");
    app.add_option("--fail", options->fail,
                   "exit with 1 if a channel's RMSE is above this, a value is finite in one image "
                   "only, or a channel is missing; ids are listed but never fail");
    app.add_flag("--json", options->json, "print the result as JSON");
    app.footer(
        "max, rmse, mae: largest, root mean square and mean absolute error; mrse: mean of\n"
        "((A - B) / (|B| + 0.01))^2; differing: pixels that aren't equal; unmatched: those of "
        "them\n"
        "that aren't finite in both, which the errors leave out. FLIP: mean of what eyes see when\n"
        "the images alternate, 0..1 (Andersson et al. 2020, LDR: light is cut to 0..1), at 67\n"
        "pixels a degree.");
    return [options] {
        ImageDifference difference = compare_files(*options);
        if (!options->channels.empty()) select_channels(difference, options->channels);
        print_report(make_report(difference), options->json);
        if (options->fail) check_limit(difference, *options->fail);
        return 0;
    };
}

}  // namespace voxelume::cli
