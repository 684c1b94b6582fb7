// voxelume render: the image of a scene.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <atomic>
#include <chrono>
#include <filesystem>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/frame_files.hpp"
#include "cli/progress.hpp"
#include "cli/render_report.hpp"
#include "runtime/analysis/culling.hpp"
#include "runtime/analysis/model_last_uses.hpp"
#include "runtime/base/error.hpp"
#include "runtime/base/frame_list.hpp"
#include "runtime/base/version.hpp"
#include "runtime/batch/device_images.hpp"
#include "runtime/batch/frame_pipeline.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/png.hpp"
#include "runtime/io/volume_file.hpp"
#include "runtime/memory/frame_plans.hpp"
#include "runtime/render/volume_renderer.hpp"
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

[[noreturn]] void refuse_not_finite(uint32_t count) {
    throw Error(ErrorKind::render,
                "{} values of the image were not finite and became 0: please report this scene",
                count);
}

void add_attributes(const Scene& scene, int frame, Attributes& attributes) {
    attributes["scene"] = scene.file.filename().string();
    if (moves(scene)) attributes["frame"] = std::to_string(frame);
    attributes["software"] = "voxelume " + std::string(version());
}

/// Whether devices share the tiles of one image, each of which finds what is potentially visible
/// itself.
bool is_shared(const std::vector<Device>& devices, const std::vector<FrameFiles>& list) {
    return devices.size() > 1 && list.size() == 1 && list[0].volumes.empty();
}

/// Renders the frames that are asked for, and tells of them.
class FrameRun {
  public:
    /// `meshes` has what was read to check the frames.
    FrameRun(const std::vector<Device>& devices, Scene scene, const std::vector<FrameFiles>& list,
             const RenderOptions& options, AssetStore meshes)
        : devices_(devices),
          scene_(std::move(scene)),
          list_(list),
          options_(options),
          meshes_(std::move(meshes)),
          bar_("rendering", 100 * list.size(), stderr, options.quiet),
          shown_(list.size()),
          reports_(list.size()) {
        for (const Device& device : devices) {
            renderers_.emplace_back(device, list.size() > 1);
            volume_renderers_.emplace_back(device, list.size() > 1);
        }
    }

    /// Seconds of writing files, up to now.
    double write_seconds() const { return write_seconds_; }

    /// The frame from which on they were rendered one at a time, as memory doesn't suffice for two.
    std::optional<int> one_by_one_from() const { return one_by_one_from_; }

    std::vector<FrameReport> run() {
        if (is_shared(devices_, list_)) {
            render_tiles()();
            return reports_;
        }
        FrameSteps steps{[this](size_t n) { return scene_at(scene_, list_[n].frame); },
                         [this](const FrameInput& input) {
                             return in_frame(scene_, list_[input.frame].frame,
                                             [&] { return render(input); });
                         }};
        if (moves(scene_)) steps.number = [this](size_t n) { return double(list_[n].frame); };
        if (list_.size() > 1)
            steps.retained = [last_use = last_uses(scene_, numbers_of(list_))](size_t n) {
                std::vector<bool> retained(last_use.size());
                for (size_t i = 0; i < last_use.size(); ++i) retained[i] = last_use[i] > n + 1;
                return retained;
            };
        steps.forget = [this](size_t device) { forget(device); };
        const std::optional<size_t> alone =
            run_frames(devices_, list_.size(), steps, {!options_.one_by_one, std::move(meshes_)});
        if (alone) one_by_one_from_ = list_[*alone].frame;
        return reports_;
    }

  private:
    std::function<void()> render(const FrameInput& input) {
        const FrameFiles& files = list_[input.frame];
        RenderReport report;
        report.world = input.report;
        std::shared_ptr<const Image> image;
        std::shared_ptr<Volume> volume;
        uint64_t& shown = shown_[input.frame];
        if (!files.images.empty())
            image = renderers_[input.device].image(
                input.scene, input.world, report,
                [&](uint32_t i, uint32_t of) { advance(uint64_t(i) * 100 / of, shown); });
        if (!files.volumes.empty())
            volume = volume_renderers_[input.device].volume(input.scene, input.world, report);
        advance(100, shown);
        return written(input.frame, {files.frame, input.device, report}, std::move(image),
                       std::move(volume));
    }

    /// The only frame, by all devices.
    std::function<void()> render_tiles() {
        uint64_t& shown = shown_[0];
        RenderReport report;
        auto image = std::make_shared<const Image>(in_frame(scene_, list_[0].frame, [&] {
            return render_together(
                {devices_, meshes_.cache()}, scene_at(scene_, list_[0].frame), report,
                [&](uint32_t i, uint32_t of) { advance(i * 100ull / of, shown); });
        }));
        return written(0, {list_[0].frame, 0, report}, std::move(image), nullptr);
    }

    /// Takes a frame's report; returns what writes its files.
    std::function<void()> written(size_t n, const FrameReport& report,
                                  std::shared_ptr<const Image> image,
                                  std::shared_ptr<Volume> volume) {
        if (report.report.not_finite != 0) refuse_not_finite(report.report.not_finite);
        reports_[n] = report;
        return [this, image = std::move(image), volume = std::move(volume), n] {
            const auto start = std::chrono::steady_clock::now();
            if (image) write_images(*image, list_[n]);
            if (volume) write_volumes(*volume, list_[n]);
            write_seconds_ += seconds_since(start);
            tell_written(list_[n]);
        };
    }

    /// A line for logs, by which a farm follows an animation; a bar shows people as much.
    void tell_written(const FrameFiles& files) const {
        if (options_.quiet || list_.size() == 1 || describe_terminal(stderr).draws_bars) return;
        for (const auto* paths : {&files.images, &files.volumes})
            for (const std::string& path : *paths)
                fmt::print(stderr, "frame {}: {}\n", files.frame, path);
    }

    /// What a device's renderers keep of frames before.
    void forget(size_t device) {
        renderers_[device] = Renderer(devices_[device]);
        volume_renderers_[device] = VolumeRenderer(devices_[device]);
    }

    /// Shows a frame of which `percent` are done and `shown` were, before: less, where it is begun
    /// again.
    void advance(uint64_t percent, uint64_t& shown) {
        const std::lock_guard lock(bar_mutex_);
        bar_.advance(percent - std::min(percent, shown));
        shown = std::max(percent, shown);
    }

    void write_images(const Image& image, const FrameFiles& files) const {
        Attributes attributes;
        add_attributes(scene_, files.frame, attributes);
        for (const std::string& path : files.images) write(image, attributes, path, options_);
    }

    void write_volumes(Volume& volume, const FrameFiles& files) const {
        add_attributes(scene_, files.frame, volume.attributes);
        for (const std::string& path : files.volumes) write_volume(path, volume);
    }

    const std::vector<Device>& devices_;
    Scene scene_;
    const std::vector<FrameFiles>& list_;
    const RenderOptions& options_;
    AssetStore meshes_;
    std::vector<Renderer> renderers_;
    std::vector<VolumeRenderer> volume_renderers_;
    Progress bar_;
    std::mutex bar_mutex_;
    std::atomic<double> write_seconds_ = 0;
    std::vector<uint64_t> shown_;  ///< of each frame, percent
    std::vector<FrameReport> reports_;
    std::optional<int> one_by_one_from_;
};

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
    AssetStore meshes(model_cache(options.scene));
    if (!is_shared(devices, list)) find_potentially_visible(scene, frames, meshes);
    if (frames.size() > 1)
        for (const Device& device : devices) check_frames(scene, frames, meshes, device.info());
    if (options.verbose || !options.stats.empty())
        for (const Device& device : devices) device.time_kernels(true);

    const double open_seconds = seconds_since(start);

    FrameRun rendering(devices, scene, list, options, std::move(meshes));
    const std::vector<FrameReport> reports = rendering.run();
    for (const Device& device : devices) device.finish();
    const Outcome outcome{devices,
                          reports,
                          scene.render.size,
                          count_files(list),
                          open_seconds,
                          rendering.write_seconds(),
                          rendering.one_by_one_from(),
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
