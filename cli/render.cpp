// voxelume render: the image of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/scene_options.hpp"
#include "runtime/error.hpp"
#include "runtime/io/atomic_file.hpp"
#include "runtime/io/exr.hpp"
#include "runtime/io/frame_list.hpp"
#include "runtime/io/frame_path.hpp"
#include "runtime/io/png.hpp"
#include "runtime/io/progress.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/renderer.hpp"
#include "runtime/stages/display_frame.hpp"
#include "runtime/version.hpp"
#include "runtime/volume_renderer.hpp"

namespace voxelume::cli {
namespace {

struct RenderOptions {
    SceneOptions scene;
    std::vector<std::string> outputs, volumes;
    std::string frames;
    float exposure = 0;
    bool float_color = false;
    std::string stats;
    bool plan_only = false;
    bool verbose = false;
    bool quiet = false;
};

/// What a render came to, for the summary line and --stats-json.
struct Outcome {
    const Device& device;
    const RenderReport& report;
    glm::ivec2 size;
    size_t files;
    double seconds;
};

/// The files of one frame, or of all that --frames names. Nothing moves yet, so they are all alike.
std::vector<std::string> output_files(const RenderOptions& options) {
    if (options.outputs.empty() && options.volumes.empty() && !options.plan_only)
        throw Error(ErrorKind::usage,
                    "render: say where the image goes: -o image.exr, or --volume image.vdb");
    const bool animation = !options.frames.empty();
    const std::vector<int> frames = animation ? parse_frame_list(options.frames) : std::vector{1};
    std::vector<std::string> files;
    for (const int frame : frames)
        for (const std::string& pattern : options.outputs)
            files.push_back(frame_path(pattern, frame, animation));
    return files;
}

/// The volumetric files likewise. Without --frames the #### of slices is left to their writer.
std::vector<std::string> volume_files(const RenderOptions& options) {
    if (options.frames.empty()) return options.volumes;
    std::vector<std::string> files;
    for (const int frame : parse_frame_list(options.frames))
        for (const std::string& pattern : options.volumes)
            files.push_back(frame_path(pattern, frame, true));
    return files;
}

/// A disk that can't take the image should say so before the work, not after. All frames of a
/// pattern are in one folder, so the first ones stand for all.
void check_outputs(const std::vector<std::string>& files, const RenderOptions& options) {
    for (size_t i = 0; i < options.outputs.size() && i < files.size(); ++i)
        check_output(files[i], {".exr", ".png"}, "render");
    if (options.stats.empty()) return;
    check_output(options.stats, {}, "render");
    if (std::ranges::find(files, options.stats) != files.end())
        throw Error(ErrorKind::usage, "render: {}: the image and the statistics have one name",
                    options.stats);
}

void write(const Image& image, const std::string& path, const RenderOptions& options) {
    if (std::filesystem::path(path).extension() == ".png") {
        PngOptions png;
        png.exposure = options.exposure;
        write_png(path, image, png);
    } else {
        write_exr(path, image, options.float_color ? ColorDepth::float32 : ColorDepth::float16);
    }
}

nlohmann::ordered_json statistics(const Outcome& outcome) {
    const DeviceCounters& counters = outcome.device.counters();
    const RenderReport& report = outcome.report;
    nlohmann::ordered_json json;
    json["version"] = version();
    json["device"] = outcome.device.info().name;
    json["driver"] = outcome.device.info().driver;
    json["lanes"] = outcome.device.lanes();
    json["size"] = {outcome.size.x, outcome.size.y};
    json["files"] = outcome.files;
    json["voxels"] = report.voxels;
    json["triangles"] = report.world.triangles;
    json["sight_rays"] = report.sight_rays;
    json["shadow_rays"] = report.shadow_rays;
    json["secondary_rays"] = report.secondary_rays;
    json["ended_paths"] = report.ended_paths;
    json["not_finite"] = report.not_finite;
    json["world_bytes"] = report.world_bytes;
    if (const InstanceReport& i = report.world.instances; i.instances > 0)
        json["instances"] = {{"number", i.instances},
                             {"models", i.models},
                             {"model_voxels", i.voxels},
                             {"model_bytes", i.bytes},
                             {"seconds", i.seconds}};
    json["peak_device_bytes"] = counters.peak_bytes;
    json["seconds"] = {
        {"load", report.world.load_seconds},   {"voxelize", report.world.voxelize_seconds},
        {"place", report.world.place_seconds}, {"index", report.world.index_seconds},
        {"image", report.image_seconds},       {"total", outcome.seconds}};
    json["kernel_ms"] = counters.kernel_ms;
    json["launches"] = counters.launches;
    json["allocated_bytes"] = counters.allocated_bytes;
    json["programs"] = {{"made", counters.programs_built},
                        {"from_cache", counters.programs_from_cache},
                        {"ms", counters.build_ms}};
    return json;
}

void write_statistics(const std::string& path, const nlohmann::ordered_json& json) {
    AtomicFile file(path);
    // The device's name may be in any encoding.
    const std::string text =
        json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n";
    file.write(text.data(), text.size());
    file.commit();
}

/// "845", "84.5 k", "8.45 M"
std::string count_text(uint64_t count) {
    const double n = double(count);
    if (n < 1e4) return fmt::format("{}", count);
    return n < 1e6 ? fmt::format("{:.1f} k", n / 1e3) : fmt::format("{:.2f} M", n / 1e6);
}

void print_summary(const Outcome& outcome) {
    const RenderReport& report = outcome.report;
    const std::string secondary =
        report.secondary_rays > 0
            ? fmt::format(", {} secondary rays ({} paths ended early)",
                          count_text(report.secondary_rays), count_text(report.ended_paths))
            : "";
    fmt::print(stderr,
               "{}x{} in {:.2f} s on \"{}\": {} voxels, {} sight and {} shadow rays{}; "
               "load {:.0f} ms, voxelize {:.0f}, place {:.0f}, index {:.0f}, image {:.0f}\n",
               outcome.size.x, outcome.size.y, outcome.seconds, outcome.device.info().name,
               count_text(report.voxels), count_text(report.sight_rays),
               count_text(report.shadow_rays), secondary, report.world.load_seconds * 1e3,
               report.world.voxelize_seconds * 1e3, report.world.place_seconds * 1e3,
               report.world.index_seconds * 1e3, report.image_seconds * 1e3);
}

void print_details(const Outcome& outcome) {
    const DeviceCounters& counters = outcome.device.counters();
    fmt::print(stderr, "  {} lanes, driver {}; {} triangles; world {:.1f} MB, at most {:.1f} MB\n",
               outcome.device.lanes(), outcome.device.info().driver, outcome.report.world.triangles,
               double(outcome.report.world_bytes) / 1e6, double(counters.peak_bytes) / 1e6);
    fmt::print(stderr, "  {} programs in {:.0f} ms, {} of them compiled before\n",
               counters.programs_built, counters.build_ms, counters.programs_from_cache);
    for (const auto& [kernel, ms] : counters.kernel_ms)
        fmt::print(stderr, "  {:<24}{:>10.2f} ms {:>6} launches\n", kernel, ms,
                   counters.launches.at(kernel));
}

Image render_with_bar(const Device& device, const Scene& scene, RenderReport& report, bool quiet) {
    Progress bar("rendering", 100, stderr, quiet);
    uint64_t shown = 0;
    return render(device, scene, report, [&](uint32_t done, uint32_t total) {
        const uint64_t percent = uint64_t(done) * 100 / total;
        bar.advance(percent - shown);
        shown = percent;
    });
}

[[noreturn]] void refuse_not_finite(uint32_t count) {
    throw Error(ErrorKind::render,
                "{} values of the image were not finite and became 0: please report this scene",
                count);
}

void add_attributes(const Scene& scene, std::map<std::string, std::string>& attributes) {
    attributes["scene"] = scene.file.filename().string();
    attributes["software"] = "voxelume " + std::string(version());
}

void render_images(const Device& device, const Scene& scene, const RenderOptions& options,
                   const std::vector<std::string>& files, RenderReport& report) {
    Image image = render_with_bar(device, scene, report, options.quiet);
    if (report.not_finite != 0) refuse_not_finite(report.not_finite);
    add_attributes(scene, image.attributes);
    for (const std::string& path : files) write(image, path, options);
}

void render_volumes(const Device& device, const Scene& scene, const std::vector<std::string>& files,
                    RenderReport& report) {
    Volume volume = render_volume(device, scene, report);
    if (report.not_finite != 0) refuse_not_finite(report.not_finite);
    add_attributes(scene, volume.attributes);
    for (const std::string& path : files) write_volume(path, volume);
}

int run(const RenderOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    const std::vector<std::string> files = output_files(options), volumes = volume_files(options);
    check_outputs(files, options);
    const Scene scene = read_with(options.scene, "render");
    for (const std::string& path : volumes) check_volume_output(path, display_frame(scene));
    const Device device = Device::open(options.scene.device);
    if (options.plan_only) {
        print_plan(scene, device, false);
        return 0;
    }
    if (options.verbose || !options.stats.empty()) device.time_kernels(true);

    RenderReport report;
    if (!files.empty()) render_images(device, scene, options, files, report);
    if (!volumes.empty()) render_volumes(device, scene, volumes, report);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    const Outcome outcome{device, report, scene.render.size, files.size() + volumes.size(),
                          seconds};
    if (!options.stats.empty()) write_statistics(options.stats, statistics(outcome));
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
    app.add_option("--frames", options->frames,
                   "frames like 1-10,20,30-60x5; #### in an output's name is the number");
    app.add_option("--exposure", options->exposure, "of .png, in stops")->check(in_range(-64, 64));
    app.add_flag("--float", options->float_color, "colour of .exr as 32-bit floats, not halves");
    app.add_option("--stats-json", options->stats, "file for counts and times");
    app.add_flag("--dry-run", options->plan_only, "say what it takes, as `check` does, and stop");
    app.add_flag("-v,--verbose", options->verbose, "say more: kernels' times, memory");
    app.add_flag("-q,--quiet", options->quiet, "print errors only");
    return [options] { return run(*options); };
}

}  // namespace voxelume::cli
