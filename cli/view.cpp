// voxelume view: a look at a volumetric image, as a picture or as a page for a browser.
#include <CLI/CLI.hpp>
#include <filesystem>
#include <glm/trigonometric.hpp>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "runtime/image/volume_view.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume/volume_page.hpp"
#include "runtime/io/volume_file.hpp"

namespace voxelume::cli {
namespace {

constexpr int kMinSide = 64;

struct ViewCommand {
    std::string from, size = "1280x1000";
    std::vector<std::string> outputs;
    double around = 35, above = 25;
    float exposure = 0;
};

int run(const ViewCommand& command) {
    const glm::ivec2 size = parse_size(command.size, "view");
    if (size.x < kMinSide || size.y < kMinSide)
        throw Error(ErrorKind::usage, "view: --size {}: a sheet has at least {} pixels a side",
                    command.size, kMinSide);
    for (const std::string& output : command.outputs)
        check_output(output, {".png", ".html"}, "view");
    const Volume volume = read_volume(command.from);
    const ViewPoint view{glm::radians(command.around), glm::radians(command.above)};
    PngOptions png;
    png.exposure = command.exposure;
    for (const std::string& output : command.outputs) {
        if (std::filesystem::path(output).extension() == ".html")
            write_volume_page(output, volume, {view, command.exposure});
        else
            write_png(output, view_sheet(volume, view, size), png);
    }
    return 0;
}

}  // namespace

Action add_view(CLI::App& app) {
    const auto command = std::make_shared<ViewCommand>();
    app.add_option("VOLUME", command->from, "volumetric image: .vdb .exr .nrrd .raw or .json")
        ->required();
    app.add_option("-o,--output", command->outputs,
                   ".png: from the front, from another side, and in slices from near to far; "
                   ".html: a page to turn and slice it in; may be given again")
        ->required()
        ->allow_extra_args(false);
    app.add_option("--around", command->around,
                   "degrees to the observer's right of that other side, 35 by default")
        ->check(in_range(-360, 360));
    app.add_option("--above", command->above, "degrees above, 25 by default")
        ->check(in_range(-90, 90));
    app.add_option("--size", command->size, ".png: WIDTHxHEIGHT in pixels, 1280x1000 by default");
    app.add_option("--exposure", command->exposure, "stops, 0 by default")
        ->check(in_range(-64, 64));
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
