// SPDX-License-Identifier: Apache-2.0
// voxelume view: shows a volumetric image as a picture or as a page for a browser.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <optional>
#include <string>
#include <variant>
#include <vector>

#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/import_options.hpp"
#include "cli/shared/scene_options.hpp"
#include "cli/shared/slice_names.hpp"

namespace voxelume::cli {
namespace {

constexpr int kMinSide = 64;

struct ViewCommand {
    std::string from, size = "1280x1000", device;
    std::vector<std::string> outputs;
    std::vector<std::filesystem::path> assets;
    double around = 35, above = 25;
    double exposure = 0;
};

/// A scene with what a model file contains, and a lattice display.
Scene scene_of_model(const std::string& from) {
    ImportOptions options;
    options.lattice = true;
    return scene_of_file(from, options);
}

Volume volume_of_scene(const ViewCommand& command, const Scene& scene) {
    return render_volume(scene, {Device::open(command.device)});
}

bool is_scene(const Facts& facts) {
    const auto& members = std::get<std::vector<Facts>>(facts.value);
    const auto kind = std::ranges::find(members, "kind", &Facts::name);
    const auto* const text =
        kind == members.end() ? nullptr : std::get_if<std::string>(&kind->value);
    return text != nullptr && *text == "scene";
}

/// Reads a JSON file, which is the header of a volumetric image or a scene that shows one.
Volume volume_of_json(const ViewCommand& command, const std::string& from) {
    v1::SceneOptions options;
    options.assets = command.assets;
    if (!is_scene(describe_file(from, options))) return Volume::read(from);
    return volume_of_scene(command, load_scene(from, options));
}

/// Reads an OpenVDB file, which is a volumetric image or else a model. If it is neither, the error
/// is that of reading a volumetric image.
Volume volume_of_vdb(const ViewCommand& command, const std::string& from) {
    std::optional<Error> refusal;
    try {
        return Volume::read(from);
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        refusal = error;
    }
    std::optional<Scene> scene;
    try {
        scene = scene_of_model(from);
    } catch (const Error&) {
        throw Error(*refusal);
    }
    return volume_of_scene(command, *scene);
}

/// The volumetric image of a file, or of the contents of a model file.
Volume volume_of(const ViewCommand& command) {
    const std::string from = first_slice(command.from);
    if (ending_of(from) == ".vdb") return volume_of_vdb(command, from);
    if (ending_of(from) == ".json") return volume_of_json(command, from);
    if (!is_model_file(from)) return Volume::read(from);
    return volume_of_scene(command, scene_of_model(from));
}

int run(const ViewCommand& command) {
    const Size size = parse_size(command.size, "view");
    if (size[0] < kMinSide || size[1] < kMinSide)
        fail_usage("view: --size {}: a sheet has at least {} pixels a side", command.size,
                   kMinSide);
    for (const std::string& output : command.outputs)
        check_output(output, {".png", ".html"}, "view");
    const Volume volume = volume_of(command);
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
           "VOLUME", command->from,
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
    app.add_option("--assets", command->assets,
                   "folder to look for a scene's models in; may be given again")
        ->allow_extra_args(false);
    app.add_option("--device", command->device,
                   "device for scenes and model files: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE");
    app.add_option("--exposure", command->exposure, "exposure in stops, 0 by default")
        ->check(in_range(-64, 64));
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
