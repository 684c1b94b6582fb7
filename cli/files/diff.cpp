// SPDX-License-Identifier: Apache-2.0
// voxelume diff A B: compares two images, or the frames of two animations.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/files/diff_files.hpp"
#include "cli/files/diff_findings.hpp"
#include "cli/files/diff_images.hpp"
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

int run(DiffCommand command) {
    const CompareOptions options{listed(command.channels), command.threshold};
    DiffLimits& limits = command.limits;
    if (!limits.flip && !command.names.flip.empty())
        limits.flip = 1;  // a picture needs a limit,
                          // too
    check_colors(limits, options.channels);
    for (const std::string& picture : {command.names.output, command.names.flip})
        if (!picture.empty()) check_image_output(picture, "diff");
    const std::vector<DiffFiles> list = diff_files(command.names);
    check_outputs(list);
    DiffFindings findings(limits, command.names.is_animation(), command.json);
    for (const DiffFiles& files : list) try {
            check_inputs(files);
            findings.add(files, compare_files(files, options, limits));
        } catch (const Error& error) {
            const bool is_of_images =
                error.kind() == ErrorKind::input || error.kind() == ErrorKind::render;
            if (!is_of_images || !command.names.is_animation()) throw;
            findings.add_failure(files, error);
        }
    print_report(findings.report(), command.json);
    findings.throw_faults();
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
