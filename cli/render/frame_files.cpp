// SPDX-License-Identifier: Apache-2.0
#include "cli/render/frame_files.hpp"

#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <filesystem>
#include <numeric>

#include "cli/output/output_stream.hpp"
#include "cli/output/shard.hpp"
#include "cli/render/finished_files.hpp"
#include "cli/render/render_progress.hpp"
#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

bool is_slices(const std::string& volume) {
    return ending_of(volume) == ".png";
}

/// A frame's name for slices. The last #### belongs to the slices, so the frame's number replaces
/// the #### before it, or is put in front. A name without #### is left for a message about it.
std::string slices_path(const std::string& pattern, int frame) {
    const size_t name = pattern.find_last_of('/') + 1;
    const size_t last = pattern.find_last_of("#%");
    if (last == std::string::npos || last < name) return pattern;
    const size_t before = pattern.find_last_not_of('#', last);
    const size_t run = pattern[last] == '%' ? last : before == pattern.npos ? 0 : before + 1;
    const std::string start = pattern.substr(0, run), own = pattern.substr(run);
    const std::string numbered = frame_path(start, frame, false);
    if (numbered != start) return numbered + own;
    const bool ends_in_digit =
        run > name && std::string_view("0123456789").find(start.back()) != std::string_view::npos;
    return start + fmt::format("{}{:04}.", ends_in_digit ? "." : "", frame) + own;
}

bool is_pattern(const std::string& path) {
    return frame_path(path, 1, false) != path;
}

/// True if an output without --frames asks for the whole animation: a name with #### does, except
/// for slices, whose #### is left to their writer.
bool wants_all_frames(const RenderCommand& options) {
    return std::ranges::any_of(options.outputs, is_pattern) ||
           std::ranges::any_of(options.volumes, [](const std::string& path) {
               return is_pattern(path) && !is_slices(path);
           });
}

/// The frames of --frames; otherwise, all frames of a moving scene, or one.
std::vector<int> frames_of(const RenderCommand& options, const Scene& scene) {
    if (!options.frames.empty()) return parse_frame_list(options.frames);
    const bool all = scene.moves() && (wants_all_frames(options) || options.plan_only);
    std::vector<int> frames(all ? size_t(scene.frames()) : 1);
    std::iota(frames.begin(), frames.end(), 1);
    return frames;
}

/// Checks that standard output gets at most one image, and nothing else.
void check_stream(const RenderCommand& options) {
    const auto count = std::ranges::count_if(options.outputs, is_stream);
    if (count == 0) return;
    if (count > 1) fail_usage("render: two outputs are standard output; leave one of them out");
    if (options.plan_only) fail_usage("render: --dry-run and -o - both write standard output");
    if (isatty(STDOUT_FILENO) == 1)
        fail_usage(
            "render: -o -: standard output is a terminal; write the image to a file or pipe");
}

/// Refuses options that change no file: those of .png files where none is written, and those of
/// .exr files likewise.
void check_effects(const RenderCommand& options) {
    if (options.plan_only) return;
    const auto writes = [&](std::string_view ending) {
        return std::ranges::any_of(options.outputs, [&](const std::string& output) {
            return ending_of(output == "-" ? "-.png" : output) == ending;
        });
    };
    const RenderCommand usual;
    const auto refuse = [&](bool is_given, const char* option, const char* ending) {
        if (is_given && !writes(ending))
            fail_usage("render: {} changes {} files, and -o names none: leave it out, or name one",
                       option, ending);
    };
    refuse(options.exposure != usual.exposure, "--exposure", ".png");
    refuse(options.view_transform != usual.view_transform, "--view-transform", ".png");
    refuse(options.png_bits != usual.png_bits, "--png-bits", ".png");
    refuse(options.float_color, "--float", ".exr");
    refuse(options.multi_part, "--multi-part", ".exr");
    refuse(options.channels != usual.channels, "--channels", ".exr");
}

/// Adds the options for inputs and outputs.
void add_input_options(CLI::App& app, RenderCommand& command) {
    app.add_option("SCENE", command.inputs,
                   "scene files, JSON (see scenes/README.md), or model files (see "
                   "scenes/manual/model_files.md): " +
                       model_endings())
        ->required();
    add_scene_options(app, command.scene);
    app.add_option("-o,--output", command.outputs,
                   "image file, .exr or .png; may be given again; {name} in it is the input's name")
        ->allow_extra_args(false);
    app.add_option("--volume", command.volumes,
                   "volumetric image of the scene's display: .vdb .exr .nrrd .raw, name.####.png "
                   "or a display's own format; may be given again")
        ->allow_extra_args(false);
}

/// Adds the options for several images in one run. Returns --frames.
const CLI::Option* add_frame_options(CLI::App& app, RenderCommand& command) {
    const CLI::Option* frames = app.add_option("--frames", command.frames,
                                               "frames to render, like 1-10,20,30-60x5; #### in an "
                                               "output's name becomes the number")
                                    ->type_name("FRAMES");
    app.add_option("--views", command.views,
                   "render this many views around the scene; {view} in an output's name becomes "
                   "the number")
        ->check(in_range(1, 10000, Number::whole));
    add_quilt_options(app, command.quilt);
    app.add_option("--sweep", command.sweeps,
                   "render the scene with each of the values, PATH=V1,V2 or PATH=[1,2],[3,4]; the "
                   "path's last key in braces, or {sweep}, in an output's name becomes the value "
                   "or its number; may be given again, for all combinations")
        ->type_name("PATH=V1,V2")
        ->allow_extra_args(false);
    return frames;
}

/// Adds the options for the contents of image files.
void add_image_options(CLI::App& app, RenderCommand& command) {
    app.add_option("--exposure", command.exposure, "exposure of .png files, in stops")
        ->check(in_range(-64, 64));
    app.add_option("--view-transform", command.view_transform,
                   "how light brighter than a screen is shown in .png files: srgb (the default, "
                   "cut off), filmic, agx, or none for linear values")
        ->type_name("srgb|filmic|agx|none");
    app.add_option("--png-bits", command.png_bits, "bits a channel of .png files, 8 or 16")
        ->type_name("8|16")
        ->check(one_of({"8", "16"}));
    app.add_flag("--float", command.float_color,
                 "write the colours of .exr files as 32-bit floats, not halves");
    app.add_flag("--multi-part", command.multi_part,
                 "write each layer of .exr files as a part of its own: rgba, depth, N, ...");
    app.add_option(
           "--channels", command.channels,
           "channels of .exr files, with commas between them: RGBA Z distance P N objectId "
           "materialId CryptoObject CryptoMaterial albedo direct indirect shadow lights "
           "motion samples noise variance; without RGBA, variance and light's parts nothing "
           "is lit")
        ->type_name("CHANNELS");
}

/// Adds the options for how much is rendered, and on what.
void add_run_options(CLI::App& app, RenderCommand& command) {
    app.add_option("--stats-json", command.stats,
                   "write counts, times and memory to this file, JSON (see cli/STATISTICS.md)");
    app.add_flag("--dry-run", command.plan_only,
                 "print what rendering needs, as `check` does, and stop");
    app.add_flag("--no-overlap", command.one_by_one,
                 "build, render and write one frame after another, in less memory; several devices "
                 "always do so, each with its own frames");
    app.add_option("--crop", command.crop,
                   "render X,Y,WIDTH,HEIGHT of the image alone, in pixels from the top left; .exr "
                   "files have it as their data window")
        ->type_name("X,Y,W,H");
    app.add_option("--shard", command.shard,
                   "render part I of N alone, of the frames or of one image; `voxelume merge` puts "
                   "the parts together")
        ->type_name("I/N");
    app.add_option("--fallback", command.fallback,
                   "device, as for --device, that takes over a run whose device fails")
        ->type_name("DEVICES");
}

/// Adds the options for existing files and for progress.
void add_progress_options(CLI::App& app, RenderCommand& command) {
    app.add_option("--overwrite", command.overwrite,
                   "which files to render that are there already: always (the default), never, or "
                   "changed: those that are damaged, or made from something else")
        ->type_name("always|never|changed");
    app.add_flag("--resume", command.resume,
                 "go on where a run ended: the same as --overwrite changed");
    app.add_option("--continue", command.earlier,
                   "add samples to this .exr image of an earlier run with --float and fewer "
                   "--samples; the result is that of one run")
        ->check([](const std::string& file) { return file.empty() ? "names no file" : ""; });
    const char* const progress = std::getenv("VOXELUME_PROGRESS");
    if (progress != nullptr && *progress != '\0') command.progress = progress;
    app.add_option("--progress", command.progress,
                   "how progress is told on stderr: auto (the default; a bar on a terminal, and "
                   "else a line for each frame), bar, plain, json (a JSON object a line), or none")
        ->type_name("auto|bar|plain|json|none");
    app.add_flag("-v,--verbose", command.verbose,
                 "print more: times of kernels, memory, a line for each frame");
    app.add_flag("-q,--quiet", command.quiet, "print errors only");
}

}  // namespace

const CLI::Option* add_render_options(CLI::App& app, RenderCommand& command) {
    add_input_options(app, command);
    const CLI::Option* frames = add_frame_options(app, command);
    add_image_options(app, command);
    add_run_options(app, command);
    add_progress_options(app, command);
    return frames;
}

std::vector<FrameFiles> frame_files(const RenderCommand& options, const Scene& scene) {
    const std::vector<int> frames = frames_of(options, scene);
    const bool animation = !options.frames.empty() || frames.size() > 1;
    std::vector<FrameFiles> list;
    for (const int frame : frames) {
        if (list.empty() || scene.moves()) {
            list.push_back({frame, {}, {}});
            if (!options.earlier.empty())
                list.back().earlier = frame_path(options.earlier, frame, animation);
        }
        for (const std::string& pattern : options.outputs)
            if (!is_stream(pattern))
                list.back().images.emplace_back(frame_path(pattern, frame, animation));
        for (const std::string& pattern : options.volumes)
            list.back().volumes.emplace_back(!animation ? pattern
                                             : is_slices(pattern)
                                                 ? slices_path(pattern, frame)
                                                 : frame_path(pattern, frame, true));
    }
    return list;
}

std::vector<int> numbers_of(const std::vector<FrameFiles>& list) {
    std::vector<int> numbers;
    numbers.reserve(list.size());
    for (const FrameFiles& files : list) numbers.push_back(files.frame);
    return numbers;
}

void check_options(const RenderCommand& options) {
    if (options.outputs.empty() && options.volumes.empty() && !options.plan_only)
        fail_usage("render: say where the image goes: -o image.exr, or --volume image.vdb");
    const bool animation = !options.frames.empty();
    const int first = animation ? parse_frame_list(options.frames).front() : 1;
    progress_style(options.progress);
    if (!options.shard.empty()) parse_shard(options.shard);
    overwrite_of(options);
    if (options.quilt.cone && options.quilt.views.empty())
        fail_usage("render: --cone is of a quilt: add --quilt COLUMNSxROWS, or leave it out");
    if (options.quilt.focus > 0 && !options.quilt.is_asked_for())
        fail_usage(
            "render: --focus is of quilts and stereo pairs: add --quilt or --stereo, or "
            "leave it out; a lens is focused by the observer's \"focus\"");
    if (!options.earlier.empty() && !(options.shard.empty() && !options.quilt.is_asked_for()))
        fail_usage("render: --continue adds samples to whole images of one view: leave out {}",
                   !options.shard.empty()        ? "--shard"
                   : options.quilt.views.empty() ? "--stereo"
                                                 : "--quilt");
    if (!options.earlier.empty() && options.plan_only)
        fail_usage("render: --dry-run tells of whole images: leave out --continue");
    if (!options.earlier.empty() && options.outputs.empty())
        fail_usage("render: --continue adds samples to an image: name one by -o");
    check_stream(options);
    for (const std::string& pattern : options.outputs)
        if (!is_stream(pattern))
            for (const std::filesystem::path& file :
                 files_of_eyes(frame_path(pattern, first, animation), options.quilt))
                check_image_output(file, "render");
    check_effects(options);
    if (options.stats == "-")
        fail_usage("render: --stats-json -: statistics go to a file, not to standard output");
    if (!options.stats.empty()) check_output(options.stats, {}, "render");
}

void check_files(const std::vector<FrameFiles>& list, const Scene& scene,
                 const RenderCommand& options) {
    if (list.size() > 1 && std::ranges::any_of(options.outputs, is_stream))
        fail_usage("render: -o -: standard output takes one image, not {}; choose with --frames",
                   list.size());
    std::vector<std::string> names{options.stats};
    for (const FrameFiles& files : list) {
        for (const auto* paths : {&files.images, &files.volumes})
            for (const std::filesystem::path& path : *paths)
                for (const std::filesystem::path& file : files_of_eyes(path, options.quilt))
                    names.push_back(file.string());
        for (const std::filesystem::path& path : files.volumes) check_volume_file(path, scene);
    }
    check_distinct(names, "render");
}

}  // namespace voxelume::cli
