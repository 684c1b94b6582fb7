// SPDX-License-Identifier: Apache-2.0
// voxelume convert A B: writes a volumetric image, or voxels, in another format.
#include <CLI/CLI.hpp>
#include <array>
#include <string>

#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/slice_names.hpp"
#include "cli/shared/tell.hpp"

namespace voxelume::cli {

namespace {

struct ConvertCommand {
    std::string from, to;
    std::string format, dither = "bayer8", sweep = "y";
    bool uncompressed = false;
    VolumeFileOptions options;
};

constexpr std::array kDithers = {std::pair{std::string_view("bayer8"), Dither::bayer8},
                                 std::pair{std::string_view("none"), Dither::none}};
constexpr std::array kSweeps = {std::pair{std::string_view("x"), Axis::x},
                                std::pair{std::string_view("y"), Axis::y},
                                std::pair{std::string_view("z"), Axis::z}};

/// The format of a volumetric image. Throws for a file of voxels, which can't become one.
VolumeFormat format_of(const std::string& from, const std::string& to) {
    const bool has_voxels = is_model_file(from) && ending_of(from) != ".vdb";
    if (has_voxels)
        fail_usage("convert: {}: voxels are written as {} {}", to, endings_of_voxels(false),
                   endings_of_voxels(true));
    return volume_format_of(to);
}

int run(const ConvertCommand& command) {
    const std::string from = first_slice(command.from);
    if (is_mesh_name(from))
        fail_usage("convert: {}: is a mesh, whose voxels `voxelume voxelize` makes", from);
    if (command.format.empty() && can_convert_voxels(from, command.to)) {
        for (const std::string& note : convert_voxels(from, command.to)) tell("note: {}\n", note);
        return 0;
    }
    VolumeFileOptions options = command.options;
    options.dither = choose(command.dither, kDithers, "convert: --dither");
    options.sweep = choose(command.sweep, kSweeps, "convert: --sweep");
    options.compress = !command.uncompressed;
    options.format =
        command.format.empty() ? format_of(from, command.to) : volume_format_named(command.format);
    Volume::read(from).write(command.to, options);
    return 0;
}

}  // namespace

Action add_convert(CLI::App& app) {
    const auto command = std::make_shared<ConvertCommand>();
    VolumeFileOptions& options = command->options;
    app.add_option("A", command->from,
                   "volumetric image to read: .vdb .exr .nrrd .raw or .json; or voxels: .vox .vxm "
                   ".vdb .npy .qb .gox .schem and others")
        ->required();
    app.add_option("B", command->to,
                   fmt::format("volumetric image to write: the same, or name.####.png .ply .kv6 "
                               ".planes .cplanes .rgb332 .rgb565; or of voxels {} {}",
                               endings_of_voxels(false), endings_of_voxels(true)))
        ->required();
    const auto formats = volume_format_names();
    app.add_option("--format", command->format,
                   fmt::format("for any name of B: {}", fmt::join(formats, ", ")))
        ->type_name(fmt::format("{}", fmt::join(formats, "|")));
    app.add_flag("--all", options.all_values, "NRRD: also write depth, object and kind");
    app.add_flag("--uncompressed", command->uncompressed, "NRRD: write raw data, not gzip");
    app.add_option("--dither", command->dither,
                   "display formats: dithering, bayer8 (the default) or none")
        ->type_name("bayer8|none");
    app.add_option("--exposure", options.exposure,
                   "display formats: exposure in stops, 0 by default")
        ->check(in_range(-64, 64));
    app.add_option(
           "--sweep", command->sweep,
           "bit planes: the observer's axis along which they sweep: x, y (the default) or z")
        ->type_name("x|y|z");
    app.add_option("--angles", options.angles, "rgb332, rgb565: number of angles in a turn")
        ->check(in_range(1, 65536, Number::whole));
    app.add_option("--radii", options.radii,
                   "rgb332, rgb565: number of voxels from the axis outwards")
        ->check(in_range(1, 65536, Number::whole));
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
