// voxelume render: the image of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <string>
#include <utility>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/frame_files.hpp"
#include "cli/progress.hpp"
#include "cli/render_report.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/frame_list.hpp"
#include "runtime/base/version.hpp"
#include "runtime/batch/render_frames.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/scene_file/scene_animation.hpp"

namespace voxelume::cli {
namespace {

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

constexpr ImageChannels kColorAlone{true, false, false, false, false};

/// Of OpenEXR files.
ImageChannels listed_channels(const RenderOptions& options) {
    ImageChannels channels{false, false, false, false, false};
    for (const std::string& name : CLI::detail::split(options.channels, ',')) {
        if (name == "RGBA")
            channels.color = true;
        else if (name == "Z")
            channels.depth = true;
        else if (name == "P")
            channels.position = true;
        else if (name == "N")
            channels.normal = true;
        else if (name == "objectId")
            channels.object = true;
        else
            throw Error(ErrorKind::usage,
                        "render: --channels: \"{}\" is none of Z, P, N, objectId and RGBA", name);
    }
    return channels;
}

/// Those that some output shows: PNG files colour, volumes without an image what they are made of;
/// of a dry run without any, those of OpenEXR files.
ImageChannels channels_of(const RenderOptions& options) {
    ImageChannels channels = listed_channels(options);
    if (options.outputs.empty()) return options.volumes.empty() ? channels : ImageChannels{};
    const auto has = [&](const char* extension) {
        return std::ranges::any_of(options.outputs, [&](const std::string& path) {
            return std::filesystem::path(path).extension() == extension;
        });
    };
    if (!has(".exr")) return kColorAlone;
    channels.color |= has(".png") || !options.volumes.empty();
    return channels;
}

/// The image as an OpenEXR file shows it, where what is beside it shows colour.
Image without_color(Image image) {
    for (const char* name : {"R", "G", "B", "A"}) image.planes.erase(name);
    return image;
}

using Attributes = std::map<std::string, std::string>;

void write(const Image& image, const Attributes& attributes, const std::string& path,
           const RenderOptions& options) {
    if (std::filesystem::path(path).extension() == ".png") {
        PngOptions png;
        png.exposure = options.exposure;
        write_png(path, image, png);
    } else {
        write_exr(path, listed_channels(options).color ? image : without_color(image),
                  options.float_color ? ColorDepth::float32 : ColorDepth::float16, attributes);
    }
}

void add_attributes(const Scene& scene, int frame, Attributes& attributes) {
    attributes["scene"] = scene.file.filename().string();
    if (moves(scene)) attributes["frame"] = std::to_string(frame);
    attributes["software"] = "voxelume " + std::string(version());
}

/// Writes a frame's files.
void write_files(const FrameResult& result, const FrameFiles& files, const Scene& scene,
                 const RenderOptions& options) {
    Attributes attributes;
    add_attributes(scene, files.frame, attributes);
    for (const std::string& path : files.images) write(*result.image, attributes, path, options);
    if (!result.volume) return;
    add_attributes(scene, files.frame, result.volume->attributes);
    for (const std::string& path : files.volumes) write_volume(path, *result.volume);
}

/// A line for logs, by which a farm follows an animation; a bar shows people as much.
void tell_written(const FrameFiles& files) {
    for (const auto* paths : {&files.images, &files.volumes})
        for (const std::string& path : *paths)
            fmt::print(stderr, "frame {}: {}\n", files.frame, path);
}

/// What rendering and writing frames came to.
struct Rendered {
    std::vector<FrameReport> reports;
    double write_seconds = 0;
    BatchOutcome outcome;
};

/// Renders the frames that are asked for, and tells of them.
Rendered render_and_write(const std::vector<Device>& devices, const Scene& scene,
                          const std::vector<FrameFiles>& list, const RenderOptions& options) {
    const bool tells = !options.quiet && list.size() > 1 && !describe_terminal(stderr).draws_bars;
    const uint64_t total = 100 * list.size();
    uint64_t shown = 0;
    Progress bar("rendering", total, stderr, options.quiet);
    Rendered rendered;
    BatchOptions batch;
    batch.frames = numbers_of(list);
    batch.image = !options.outputs.empty();
    batch.volume = !options.volumes.empty();
    batch.overlap = !options.one_by_one;
    batch.meshes = AssetStore(model_cache(options.scene));
    batch.progress = [&](double done, int) {
        const auto percent = uint64_t(done * double(total));
        bar.advance(percent - std::exchange(shown, percent));
    };
    rendered.outcome =
        render_frames(devices, scene, std::move(batch), [&](const FrameResult& result) {
            const auto start = std::chrono::steady_clock::now();
            const FrameFiles& files = list[rendered.reports.size()];
            rendered.reports.push_back(result.report);
            write_files(result, files, scene, options);
            rendered.write_seconds += seconds_since(start);
            if (tells) tell_written(files);
        });
    return rendered;
}

size_t count_files(const std::vector<FrameFiles>& list) {
    size_t count = 0;
    for (const FrameFiles& files : list) count += files.images.size() + files.volumes.size();
    return count;
}

int run(const RenderOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    check_options(options);
    Scene scene = read_with(options.scene, "render");
    scene.render.channels = channels_of(options);
    const std::vector<FrameFiles> list = frame_files(options, scene);
    check_files(list, scene, options);
    const std::vector<int> frames = numbers_of(list);
    const std::vector<Device> devices = Device::open_all(options.scene.device);
    if (options.plan_only) {
        print_plan(scene, frames, devices[0], model_cache(options.scene), false);
        return 0;
    }
    if (options.verbose || !options.stats.empty())
        for (const Device& device : devices) device.time_kernels(true);
    const double open_seconds = seconds_since(start);
    const Rendered rendered = render_and_write(devices, scene, list, options);
    const Outcome outcome{devices,
                          rendered.reports,
                          scene.render.size,
                          count_files(list),
                          open_seconds + rendered.outcome.check_seconds,
                          rendered.write_seconds,
                          rendered.outcome.one_by_one_from,
                          seconds_since(start)};
    if (!options.stats.empty()) write_statistics(options.stats, outcome);
    if (options.quiet) return 0;
    print_summary(outcome);
    if (options.verbose) print_details(outcome);
    return 0;
}

}  // namespace

Action add_render(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    add_scene_options(app, options->scene);
    app.add_option("-o,--output", options->outputs, "image: .exr or .png; may be given again")
        ->allow_extra_args(false);
    app.add_option("--volume", options->volumes,
                   "volumetric image of the scene's display: .vdb .exr .nrrd .raw, name.####.png "
                   "and displays' own formats; may be given again")
        ->allow_extra_args(false);
    const CLI::Option* frames =
        app.add_option("--frames", options->frames,
                       "frames like 1-10,20,30-60x5; #### in an output's name is the number");
    app.add_option("--exposure", options->exposure, "of .png, in stops")->check(in_range(-64, 64));
    app.add_flag("--float", options->float_color, "colour of .exr as 32-bit floats, not halves");
    app.add_option("--channels", options->channels,
                   "of .exr: some of RGBA,Z,P,N,objectId; without RGBA nothing is lit");
    app.add_option("--stats-json", options->stats, "file for counts and times");
    app.add_flag("--dry-run", options->plan_only, "say what it takes, as `check` does, and stop");
    app.add_flag(
        "--no-overlap", options->one_by_one,
        "of several frames, form, render and write one after another: less memory; several "
        "devices always do, each with its own frames");
    app.add_flag("-v,--verbose", options->verbose, "say more: kernels' times, memory");
    app.add_flag("-q,--quiet", options->quiet, "print errors only");
    return [options, frames] {
        // An empty list would be taken for none given.
        if (frames->count() > 0 && options->frames.empty()) parse_frame_list(options->frames);
        return run(*options);
    };
}

}  // namespace voxelume::cli
