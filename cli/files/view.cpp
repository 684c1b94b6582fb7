// SPDX-License-Identifier: Apache-2.0
// voxelume view: shows a volumetric image as a picture or as a page for a browser.
#include <CLI/CLI.hpp>
#include <memory>
#include <string>
#include <vector>

#include "cli/files/view_volume.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/import_options.hpp"

namespace voxelume::cli {
namespace {

constexpr int kMinSide = 64;

struct ViewCommand {
    ViewSource source;
    std::string size = "1280x1000";
    std::vector<std::string> outputs;
    double around = 35, above = 25;
    double exposure = 0;
};

int run(const ViewCommand& command) {
    const Size size = parse_size(command.size, "view");
    if (size[0] < kMinSide || size[1] < kMinSide)
        fail_usage("view: --size {}: a sheet has at least {} pixels a side", command.size,
                   kMinSide);
    for (const std::string& output : command.outputs)
        check_output(output, {".png", ".html"}, "view");
    const Volume volume = volume_of(command.source);
    const ViewPoint view{command.around, command.above};
    for (const std::string& output : command.outputs) {
        if (ending_of(output) == ".html")
            volume.write_page(output, view, command.exposure);
        else
            volume.view(view, size).write(output, {.exposure = command.exposure});
    }
    return 0;
}

}  // namespace

Action add_view(CLI::App& app) {
    const auto command = std::make_shared<ViewCommand>();
    app.add_option(
           "VOLUME", command->source.from,
           "volumetric image to read: .vdb .exr .nrrd .raw or .json; or a scene, .json, or a "
           "model file (see scenes/manual/model_files.md): " +
               model_endings())
        ->required();
    app.add_option("-o,--output", command->outputs,
                   ".png: views from the front and from a side, and slices from near to far; "
                   ".html: a page to turn and slice it in; may be given again")
        ->required()
        ->allow_extra_args(false);
    app.add_option("--around", command->around,
                   "angle of the side view to the observer's right, in degrees; 35 by default")
        ->check(in_range(-360, 360));
    app.add_option("--above", command->above,
                   "angle of the side view from above, in degrees; 25 by default")
        ->check(in_range(-90, 90));
    app.add_option("--size", command->size,
                   "size of the .png, WIDTHxHEIGHT in pixels; 1280x1000 by default")
        ->type_name("WIDTHxHEIGHT");
    app.add_option("--assets", command->source.assets,
                   "folder to look for a scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_option("--device", command->source.device,
                   "device for scenes and model files: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE");
    app.add_option("--exposure", command->exposure, "exposure in stops, 0 by default")
        ->check(in_range(-64, 64));
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
