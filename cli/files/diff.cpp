// SPDX-License-Identifier: Apache-2.0
// voxelume diff A B: compares two images, or the frames of two animations.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <optional>

#include "cli/files/diff_files.hpp"
#include "cli/files/diff_limits.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/report.hpp"

namespace voxelume::cli {

namespace {

struct DiffCommand {
    DiffNames names;
    std::vector<std::string> channels;  ///< names separated by commas; empty: all
    double threshold = 0;
    DiffLimits limits;
    bool json = false;
};

/// Throws Error::usage if FLIP is wanted for channels without the colours.
void check_colors(const DiffLimits& limits, const std::vector<std::string>& channels) {
    if (!limits.flip || channels.empty()) return;
    for (const char* color : {"R", "G", "B"})
        if (std::ranges::find(channels, color) == channels.end())
            fail_usage("diff: FLIP compares colours, and --channels leaves {} out", color);
}

/// Throws if images lack the channels to compare.
void check_channels(const Image& a, const Image& b, const DiffFiles& files,
                    const ImageDifference& difference, const DiffLimits& limits) {
    if (difference.channels.empty())
        throw Error(ErrorKind::render,
                    fmt::format("{} and {} have no channel in common", files.a, files.b));
    if (!limits.flip) return;
    for (const char* color : {"R", "G", "B"})
        for (const auto& [image, name] : {std::pair(&a, &files.a), std::pair(&b, &files.b)})
            if (!image->has(color))
                fail_usage("diff: FLIP compares colours, and {} has no {}", *name, color);
}

/// Compares two files, writes pictures of the differences, and names the files in messages.
ImageDifference compare_files(const DiffFiles& files, const CompareOptions& options,
                              const DiffLimits& limits) {
    const Image a = Image::read(files.a), b = Image::read(files.b);
    if (a.holds_codes() != b.holds_codes())
        fail_usage("diff: {} and {} aren't of one kind: a PNG holds codes, an EXR light", files.a,
                   files.b);
    if (a.width() != b.width() || a.height() != b.height())
        throw Error(ErrorKind::render,
                    fmt::format("{} has {} x {} pixels and {} has {} x {}", files.a, a.width(),
                                a.height(), files.b, b.width(), b.height()));
    ImageDifference difference = compare(a, b, options);
    check_channels(a, b, files, difference, limits);
    ImageFileOptions whole{.float_color = true};
    for (const ChannelRow& row : channel_table()) whole.channels.*row.member = true;
    if (!files.output.empty()) difference_image(a, b, options).write(files.output, whole);
    if (!files.flip.empty() && difference.flip) flip_image(a, b).write(files.flip, whole);
    return difference;
}

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

/// A row of an animation's table. The channel with the largest RMSE stands for all or, without an
/// error, one with unequal ids. `unmatched` is the largest count, over all channels, of unequal
/// values that aren't both finite, and `missing` are channels that only one image has.
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

/// The JSON of a frame: its row, and everything known about it as an image.
Report whole_frame(int frame, const ImageDifference& difference) {
    Report report = frame_row(frame, difference);
    report.update(report_of(difference));
    return report;
}

/// The results of a comparison so far.
struct Findings {
    Report report;
    std::optional<std::string> excess;  ///< the first limit that is exceeded
    std::optional<Error> failure;       ///< the error of the first frame that can't be compared
};

void add_image(const DiffFiles& files, const ImageDifference& difference,
               const DiffCommand& command, Findings& findings) {
    const bool is_animation = command.names.is_animation();
    if (is_animation)
        findings.report["frames"].push_back(command.json ? whole_frame(files.frame, difference)
                                                         : frame_row(files.frame, difference));
    else
        findings.report = report_of(difference);
    if (findings.excess) return;
    findings.excess = excess_of(difference, command.limits);
    if (findings.excess && is_animation)
        findings.excess = fmt::format("frame {}: {}", files.frame, *findings.excess);
}

/// Lists a frame that can't be compared. The others are still compared.
void add_failure(const DiffFiles& files, const Error& error, Findings& findings) {
    findings.report["not compared"].push_back(files.frame);
    if (!findings.failure) findings.failure = error;
}

/// Throws if the comparison fails. Frames that can't be compared take precedence over exceeded
/// limits.
void throw_findings(const Findings& findings) {
    const std::string excess =
        findings.excess ? "the images differ: " + *findings.excess : std::string();
    if (!findings.failure) {
        if (!excess.empty()) throw Error(ErrorKind::render, excess);
        return;
    }
    const size_t count = findings.report["not compared"].size();
    std::string text = findings.failure->what();
    if (count > 1) text += fmt::format("; {} frames can't be compared", count);
    if (!excess.empty()) text += "; " + excess;
    throw Error(findings.failure->kind(), text);
}

int run(DiffCommand command) {
    const CompareOptions options{listed(command.channels), command.threshold};
    DiffLimits& limits = command.limits;
    // A picture of FLIP needs a limit, too.
    if (!limits.flip && !command.names.flip.empty()) limits.flip = 1;
    check_colors(limits, options.channels);
    for (const std::string& picture : {command.names.output, command.names.flip})
        if (!picture.empty()) check_image_output(picture, "diff");
    const std::vector<DiffFiles> list = diff_files(command.names);
    check_outputs(list);
    Findings findings;
    for (const DiffFiles& files : list) try {
            check_inputs(files);
            add_image(files, compare_files(files, options, limits), command, findings);
        } catch (const Error& error) {
            const bool is_of_images =
                error.kind() == ErrorKind::input || error.kind() == ErrorKind::render;
            if (!is_of_images || !command.names.is_animation()) throw;
            add_failure(files, error, findings);
        }
    print_report(findings.report, command.json);
    throw_findings(findings);
    return 0;
}

}  // namespace

Action add_diff(CLI::App& app) {
    auto command = std::make_shared<DiffCommand>();
    app.add_option("A", command->names.a, "image to judge, OpenEXR or PNG; #### is frames' number")
        ->required();
    app.add_option("B", command->names.b, "reference image, of the same kind and size")->required();
    app.add_option("--channels", command->channels, "compare only these channels, like R,G,B")
        ->type_name("PLANES")
        ->allow_extra_args(false);
    app.add_option("--frames", command->names.frames,
                   "frames to compare, like 1-10; without it all of which there is a file")
        ->type_name("FRAMES");
    app.add_option("--threshold", command->threshold,
                   "count pixels as `above` that differ by more than this")
        ->check(in_range(0, 1e30));
    add_limit_options(app, command->limits);
    app.add_option("-o,--output", command->names.output,
                   "write a picture of |A - B|, .exr or .png; #### is frames' number");
    app.add_option("--flip-map", command->names.flip,
                   "write a picture of FLIP, .exr or .png: black, red, yellow, white as it grows");
    app.add_flag("--json", command->json, "print the result as JSON");
    app.footer(
        "max, rmse, mae: largest, root mean square and mean absolute error; mrse: mean of\n"
        "((A - B) / (|B| + 0.01))^2; differing: pixels that aren't equal; unmatched: those of "
        "them\n"
        "that aren't finite in both, which the errors leave out; above: pixels that differ by\n"
        "more than --threshold, or are unmatched. FLIP: mean of what eyes see when the images\n"
        "alternate, 0..1 (Andersson et al. 2020, LDR: light is cut to 0..1), at 67 pixels a\n"
        "degree.");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
