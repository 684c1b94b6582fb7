// voxelume render: the image of a scene.
#include <CLI/CLI.hpp>
#include <chrono>
#include <filesystem>
#include <fstream>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/commands.hpp"
#include "runtime/error.hpp"
#include "runtime/io/atomic_file.hpp"
#include "runtime/io/exr.hpp"
#include "runtime/io/frame_path.hpp"
#include "runtime/io/png.hpp"
#include "runtime/io/progress.hpp"
#include "runtime/renderer.hpp"
#include "runtime/version.hpp"

namespace voxelume::cli {
namespace {

struct RenderOptions {
    std::string scene;
    std::vector<std::string> outputs;
    std::vector<std::filesystem::path> assets;
    std::string size;
    int samples = 0;
    std::string device;
    float exposure = 0;
    bool float_color = false;
    std::string stats;
    bool quiet = false;
};

enum class OutputKind { exr, png };

/// The format that an output's name asks for.
OutputKind output_kind(const std::string& path) {
    const std::string extension = std::filesystem::path(path).extension();
    if (extension == ".exr") return OutputKind::exr;
    if (extension == ".png") return OutputKind::png;
    throw Error(ErrorKind::usage, "render: {}: an image's name ends in .exr or .png", path);
}

glm::ivec2 parse_size(const std::string& text) {
    glm::ivec2 size{0};
    char rest = 0;
    if (std::sscanf(text.c_str(), "%dx%d%c", &size.x, &size.y, &rest) != 2 || size.x < 1 ||
        size.y < 1 || size.x > kMaxImageSide || size.y > kMaxImageSide)
        throw Error(ErrorKind::usage, "render: --size {}: give WIDTHxHEIGHT, 1 to {} each", text,
                    kMaxImageSide);
    return size;
}

Scene read_with(const RenderOptions& options) {
    Scene scene = read_scene(options.scene, asset_folders(options.assets));
    if (!options.size.empty()) resize(scene, parse_size(options.size));
    if (options.samples != 0) scene.render.samples = options.samples;
    return scene;
}

void write(const Image& image, const std::string& path, const RenderOptions& options) {
    if (output_kind(path) == OutputKind::png) {
        PngOptions png;
        png.exposure = options.exposure;
        write_png(path, image, png);
    } else {
        write_exr(path, image, options.float_color ? ColorDepth::float32 : ColorDepth::float16);
    }
}

nlohmann::ordered_json statistics(const Device& device, const RenderReport& report,
                                  double seconds) {
    const DeviceCounters& counters = device.counters();
    nlohmann::ordered_json json;
    json["version"] = version();
    json["device"] = device.info().name;
    json["lanes"] = device.lanes();
    json["voxels"] = report.voxels;
    json["triangles"] = report.world.triangles;
    json["sight_rays"] = report.sight_rays;
    json["not_finite"] = report.not_finite;
    json["peak_device_bytes"] = counters.peak_bytes;
    json["seconds"] = {
        {"load", report.world.load_seconds},   {"voxelize", report.world.voxelize_seconds},
        {"place", report.world.place_seconds}, {"index", report.world.index_seconds},
        {"image", report.image_seconds},       {"total", seconds}};
    json["launches"] = counters.launches;
    json["allocated_bytes"] = counters.allocated_bytes;
    json["programs_built"] = counters.programs_built;
    return json;
}

void write_statistics(const std::string& path, const nlohmann::ordered_json& json) {
    AtomicFile file(path);
    const std::string text = json.dump(2) + "\n";
    file.write(text.data(), text.size());
    file.commit();
}

int run(const RenderOptions& options) {
    const auto start = std::chrono::steady_clock::now();
    if (options.outputs.empty())
        throw Error(ErrorKind::usage, "render: say where the image goes: -o image.exr");
    for (const std::string& path : options.outputs) output_kind(path);
    const Scene scene = read_with(options);
    const Device device = Device::open(options.device);

    RenderReport report;
    Progress bar("rendering", 100, stderr, options.quiet);
    uint64_t shown = 0;
    Image image = render(device, scene, report, [&](uint32_t done, uint32_t total) {
        const uint64_t percent = uint64_t(done) * 100 / total;
        bar.advance(percent - shown);
        shown = percent;
    });
    image.attributes = {{"scene", scene.file.filename().string()},
                        {"software", "voxelume " + std::string(version())}};
    for (const std::string& path : options.outputs)
        write(image, frame_path(path, 1, false), options);
    const double seconds =
        std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
    if (!options.stats.empty())
        write_statistics(options.stats, statistics(device, report, seconds));
    if (report.not_finite != 0)
        throw Error(ErrorKind::render,
                    "{} values of the image were not finite and became 0: please report this scene",
                    report.not_finite);
    if (!options.quiet)
        fmt::print(stderr,
                   "{}x{} in {:.2f} s on \"{}\": {} voxels, {:.2f} M sight rays; load {:.0f} ms, "
                   "voxelize {:.0f}, place {:.0f}, index {:.0f}, image {:.0f}\n",
                   image.width, image.height, seconds, device.info().name, report.voxels,
                   double(report.sight_rays) / 1e6, report.world.load_seconds * 1e3,
                   report.world.voxelize_seconds * 1e3, report.world.place_seconds * 1e3,
                   report.world.index_seconds * 1e3, report.image_seconds * 1e3);
    return 0;
}

}  // namespace

Action add_render(CLI::App& app) {
    const auto options = std::make_shared<RenderOptions>();
    app.add_option("scene", options->scene, "the scene, JSON (see scenes/README.md)")->required();
    app.add_option("-o,--output", options->outputs, "image: .exr or .png; may be given again");
    app.add_option("--assets", options->assets, "folder of models that the scene names");
    app.add_option("--size", options->size, "WIDTHxHEIGHT in pixels, instead of the scene's");
    app.add_option("--samples", options->samples, "samples per pixel, instead of the scene's")
        ->check(CLI::Range(1, 4096));
    app.add_option("--device", options->device, "auto, cpu, gpu, a number, or part of a name");
    app.add_option("--exposure", options->exposure, "of .png, in stops");
    app.add_flag("--float", options->float_color, "colour of .exr as 32-bit floats, not halves");
    app.add_option("--stats-json", options->stats, "file for counts and times");
    app.add_flag("-q,--quiet", options->quiet, "print errors only");
    return [options] { return run(*options); };
}

}  // namespace voxelume::cli
