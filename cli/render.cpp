// voxelume render: the image of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <nlohmann/json.hpp>
#include <numeric>
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
#include "runtime/scene_animation.hpp"
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

/// A frame and the files that show it.
struct FrameFiles {
    int frame = 1;
    std::vector<std::string> images, volumes;
};

bool is_pattern(const std::string& path) {
    return frame_path(path, 1, false) != path;
}

/// Whether an output without --frames asks for the whole animation: a name with #### does, but for
/// slices, whose #### is left to their writer.
bool wants_all_frames(const RenderOptions& options) {
    return std::ranges::any_of(options.outputs, is_pattern) ||
           std::ranges::any_of(options.volumes, [](const std::string& path) {
               return is_pattern(path) && std::filesystem::path(path).extension() != ".png";
           });
}

/// The frames of --frames, or else all of a moving scene, or one.
std::vector<int> frames_of(const RenderOptions& options, const Scene& scene) {
    if (!options.frames.empty()) return parse_frame_list(options.frames);
    const bool all = moves(scene) && (wants_all_frames(options) || options.plan_only);
    std::vector<int> frames(all ? size_t(scene.animation.frames) : 1);
    std::iota(frames.begin(), frames.end(), 1);
    return frames;
}

/// What is to be rendered: a frame each, or one for all where the world stands still.
std::vector<FrameFiles> frame_files(const RenderOptions& options, const Scene& scene) {
    const std::vector<int> frames = frames_of(options, scene);
    const bool animation = !options.frames.empty() || frames.size() > 1;
    std::vector<FrameFiles> list;
    for (const int frame : frames) {
        if (list.empty() || moves(scene)) list.push_back({frame, {}, {}});
        for (const std::string& pattern : options.outputs)
            list.back().images.push_back(frame_path(pattern, frame, animation));
        for (const std::string& pattern : options.volumes)
            list.back().volumes.push_back(animation ? frame_path(pattern, frame, true) : pattern);
    }
    return list;
}

/// What can be said before the scene is read: that --frames are none, that a disk can't take the
/// image. All frames of a pattern are in one folder, so the first ones stand for all.
void check_options(const RenderOptions& options) {
    if (options.outputs.empty() && options.volumes.empty() && !options.plan_only)
        throw Error(ErrorKind::usage,
                    "render: say where the image goes: -o image.exr, or --volume image.vdb");
    const bool animation = !options.frames.empty();
    const int first = animation ? parse_frame_list(options.frames).front() : 1;
    for (const std::string& pattern : options.outputs)
        check_output(frame_path(pattern, first, animation), {".exr", ".png"}, "render");
    if (!options.stats.empty()) check_output(options.stats, {}, "render");
}

void check_files(const std::vector<FrameFiles>& list, const Scene& scene,
                 const RenderOptions& options) {
    for (const FrameFiles& files : list) {
        for (const std::string& path : files.volumes)
            check_volume_output(path, display_frame(scene));
        if (!options.stats.empty() && std::ranges::count(files.images, options.stats) > 0)
            throw Error(ErrorKind::usage, "render: {}: the image and the statistics have one name",
                        options.stats);
    }
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

void add_attributes(const Scene& scene, int frame, std::map<std::string, std::string>& attributes) {
    attributes["scene"] = scene.file.filename().string();
    if (moves(scene)) attributes["frame"] = std::to_string(frame);
    attributes["software"] = "voxelume " + std::string(version());
}

void render_images(const Device& device, const Scene& scene, const RenderOptions& options,
                   const FrameFiles& files, RenderReport& report) {
    Image image = render_with_bar(device, scene, report, options.quiet);
    if (report.not_finite != 0) refuse_not_finite(report.not_finite);
    add_attributes(scene, files.frame, image.attributes);
    for (const std::string& path : files.images) write(image, path, options);
}

void render_volumes(const Device& device, const Scene& scene, const FrameFiles& files,
                    RenderReport& report) {
    Volume volume = render_volume(device, scene, report);
    if (report.not_finite != 0) refuse_not_finite(report.not_finite);
    add_attributes(scene, files.frame, volume.attributes);
    for (const std::string& path : files.volumes) write_volume(path, volume);
}

/// Adds what a frame took to what those before it took.
void add_frame(const RenderReport& frame, RenderReport& sum) {
    sum.world.load_seconds += frame.world.load_seconds;
    sum.world.voxelize_seconds += frame.world.voxelize_seconds;
    sum.world.place_seconds += frame.world.place_seconds;
    sum.world.index_seconds += frame.world.index_seconds;
    sum.world.triangles = std::max(sum.world.triangles, frame.world.triangles);
    sum.image_seconds += frame.image_seconds;
    sum.voxels = std::max(sum.voxels, frame.voxels);
    sum.world_bytes = std::max(sum.world_bytes, frame.world_bytes);
    sum.sight_rays += frame.sight_rays;
    sum.shadow_rays += frame.shadow_rays;
    sum.secondary_rays += frame.secondary_rays;
    sum.ended_paths += frame.ended_paths;
}

RenderReport render_frame(const Device& device, const Scene& scene, const FrameFiles& files,
                          const RenderOptions& options) {
    const Scene now = scene_at(scene, files.frame);
    RenderReport report;
    if (!files.images.empty()) render_images(device, now, options, files, report);
    if (!files.volumes.empty()) render_volumes(device, now, files, report);
    return report;
}

double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

int run(const RenderOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    check_options(options);
    const Scene scene = read_with(options.scene, "render");
    const std::vector<FrameFiles> list = frame_files(options, scene);
    check_files(list, scene, options);
    for (const FrameFiles& files : list) scene_at(scene, files.frame);
    const Device device = Device::open(options.scene.device);
    if (options.plan_only) {
        print_plan(scene, device, false);
        return 0;
    }
    if (options.verbose || !options.stats.empty()) device.time_kernels(true);

    RenderReport sum;
    size_t written = 0;
    for (const FrameFiles& files : list) {
        const auto frame_start = std::chrono::steady_clock::now();
        const RenderReport report = render_frame(device, scene, files, options);
        add_frame(report, sum);
        written += files.images.size() + files.volumes.size();
        if (options.quiet) continue;
        if (list.size() > 1) fmt::print(stderr, "frame {}: ", files.frame);
        print_summary({device, report, scene.render.size, written,
                       seconds_since(list.size() > 1 ? frame_start : start)});
    }
    const Outcome outcome{device, sum, scene.render.size, written, seconds_since(start)};
    if (!options.stats.empty()) write_statistics(options.stats, statistics(outcome));
    if (options.verbose && !options.quiet) print_details(outcome);
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
