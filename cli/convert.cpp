// voxelume convert A B: a volumetric image as another format.
#include <CLI/CLI.hpp>
#include <array>
#include <string>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "runtime/io/volume_file.hpp"

namespace voxelume::cli {

namespace {

struct ConvertCommand {
    std::string from, to;
    std::string format, dither = "bayer8", sweep = "y";
    bool uncompressed = false;
    VolumeOptions options;
};

constexpr std::array kDithers = {std::pair{std::string_view("bayer8"), Dither::bayer8},
                                 std::pair{std::string_view("none"), Dither::none}};
constexpr std::array kSweeps = {std::pair{std::string_view("x"), SweepAxis::x},
                                std::pair{std::string_view("y"), SweepAxis::y},
                                std::pair{std::string_view("z"), SweepAxis::z}};

int run(const ConvertCommand& command) {
    VolumeOptions options = command.options;
    options.device.dither = choose(command.dither, kDithers, "convert: --dither");
    options.device.sweep = choose(command.sweep, kSweeps, "convert: --sweep");
    options.compress = !command.uncompressed;
    options.format =
        command.format.empty() ? volume_format_of(command.to) : volume_format_named(command.format);
    write_volume(command.to, read_volume(command.from), options);
    return 0;
}

}  // namespace

Action add_convert(CLI::App& app) {
    const auto command = std::make_shared<ConvertCommand>();
    DeviceOptions& device = command->options.device;
    app.add_option("A", command->from, "volumetric image: .vdb .exr .nrrd .raw or .json")
        ->required();
    app.add_option("B", command->to,
                   "the same, or name.####.png .ply .kv6 .planes .cplanes .rgb332 .rgb565")
        ->required();
    app.add_option(
        "--format", command->format,
        "for any name of B: vdb, exr, nrrd, raw, slices, ply, kv6, planes, color-planes, "
        "rgb332, rgb565");
    app.add_flag("--all", command->options.all_values,
                 "NRRD: depth, object and kind beside red, green, blue and opacity");
    app.add_flag("--uncompressed", command->uncompressed, "NRRD: raw instead of gzip");
    app.add_option("--dither", command->dither, "displays: bayer8 (the default) or none");
    app.add_option("--exposure", device.exposure, "displays: stops, 0 by default")
        ->check(in_range(-64, 64));
    app.add_option(
        "--sweep", command->sweep,
        "planes: the observer's axis that they are swept along, x, y (the default) or z");
    app.add_option("--angles", device.angles, "rgb332, rgb565: angles of a turn")
        ->check(in_range(1, 65536, Number::whole));
    app.add_option("--radii", device.radii, "rgb332, rgb565: voxels from the axis outwards")
        ->check(in_range(1, 65536, Number::whole));
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
