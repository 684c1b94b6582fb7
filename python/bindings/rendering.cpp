// SPDX-License-Identifier: Apache-2.0
// Rendering for Python: without Python's lock, with callbacks, and stopped by Ctrl-C.
#include <algorithm>

#include "bindings.hpp"

namespace voxelume_python {
namespace {

using voxelume::Device;
using voxelume::RenderOptions;
using voxelume::Scene;

/// The devices of a call. No other call uses them at the same time.
class DevicesInUse {
  public:
    /// Waits for the devices without Python's lock. Throws Error of the kind `cancelled` when asked
    /// to stop.
    DevicesInUse(std::vector<OpenDevice> devices, const std::stop_token& stop) {
        for (const OpenDevice& open : devices) devices_.push_back(open.device);
        // Takes each lock once and always in the same order, so that two calls can't deadlock.
        const auto lock_of = [](const OpenDevice& open) { return open.in_use.get(); };
        std::ranges::sort(devices, {}, lock_of);
        const auto rest = std::ranges::unique(devices, {}, lock_of);
        devices.erase(rest.begin(), rest.end());
        for (const OpenDevice& open : devices) {
            std::unique_lock lock(*open.in_use, std::defer_lock);
            while (!lock.try_lock_for(std::chrono::milliseconds(50)))
                if (stop.stop_requested())
                    throw voxelume::Error(voxelume::ErrorKind::cancelled, "cancelled");
            locks_.push_back(std::move(lock));
        }
    }
    const std::vector<Device>& list() const { return devices_; }

  private:
    std::vector<Device> devices_;
    std::vector<std::unique_lock<std::timed_mutex>> locks_;
};

}  // namespace

voxelume::Channels channels_named(const std::vector<std::string>& names) {
    if (names.empty())
        throw voxelume::Error(voxelume::ErrorKind::usage,
                              "channels names none: leave it out for "
                              "the usual ones");
    voxelume::Channels channels = voxelume::kNoChannels;
    const auto rows = voxelume::channel_table();
    for (const std::string& name : names) {
        if (name == "color")
            channels.color = true;
        else if (name == "depth")
            channels.depth = true;
        else if (name == "position")
            channels.position = true;
        else if (name == "normal")
            channels.normal = true;
        else if (name == "object")
            channels.object = true;
        else if (const auto row = std::ranges::find(rows, name, &voxelume::ChannelRow::name);
                 row != rows.end())
            channels.*row->member = true;
        else
            throw voxelume::Error(voxelume::ErrorKind::usage,
                                  "no channel named \"" + name +
                                      "\": there are color, depth, position, normal and object, "
                                      "and the names of --channels");
    }
    return channels;
}

namespace {

/// The options of a call besides scene and devices. The callbacks belong to the caller's frame,
/// which outlives the thread that calls them.
struct Options {
    std::vector<std::string> channels;
    py::object progress, warn;
    bool strict = false;
    bool cache = true;

    RenderOptions with(const std::stop_token& stop) const {
        RenderOptions options{.channels = channels_named(channels), .strict = strict, .stop = stop};
        options.cache.enabled = cache;
        if (!progress.is_none())
            options.progress = [this](double done, int frame) {
                const py::gil_scoped_acquire acquire;
                progress(done, frame);
            };
        if (!warn.is_none())
            options.warn = [this](const voxelume::Warning& warning) {
                const py::gil_scoped_acquire acquire;
                warn(voxelume::name_of(warning.kind), warning.where, warning.text);
            };
        // A program that is being compiled can't be stopped, but no further one is started.
        options.compiling = [stop](int, int) {
            if (stop.stop_requested())
                throw voxelume::Error(voxelume::ErrorKind::cancelled, "cancelled");
        };
        return options;
    }
};

Options options_of(const std::vector<std::string>& channels, const py::object& progress,
                   const py::object& warn, bool strict, bool cache) {
    return {channels, progress, warn, strict, cache};
}

voxelume::Image render_image(const Scene& scene, const std::vector<OpenDevice>& devices, int frame,
                             const Options& options) {
    return interruptibly([&](const std::stop_token& stop) {
        const DevicesInUse in_use(devices, stop);
        return voxelume::render_image(scene, in_use.list(), frame, options.with(stop));
    });
}

voxelume::Volume render_volume(const Scene& scene, const std::vector<OpenDevice>& devices,
                               int frame, const Options& options) {
    return interruptibly([&](const std::stop_token& stop) {
        const DevicesInUse in_use(devices, stop);
        return voxelume::render_volume(scene, in_use.list(), frame, options.with(stop));
    });
}

/// Frames by their numbers, with the names of files, which have # for each digit.
voxelume::FrameJob job_of(const std::vector<int>& frames, const std::vector<std::string>& images,
                          const std::vector<std::string>& volumes) {
    voxelume::FrameJob job;
    const bool is_one_of_many = frames.size() > 1;
    for (const int number : frames) {
        voxelume::FrameFiles files{.frame = number};
        for (const std::string& image : images)
            files.images.emplace_back(voxelume::frame_path(image, number, is_one_of_many));
        for (const std::string& volume : volumes)
            files.volumes.emplace_back(voxelume::frame_path(volume, number, is_one_of_many));
        job.frames.push_back(std::move(files));
    }
    return job;
}

std::string render_frames(const Scene& scene, const std::vector<OpenDevice>& devices,
                          voxelume::FrameJob job, const py::object& deliver,
                          const Options& options) {
    if (!deliver.is_none())
        job.deliver = [&deliver](const voxelume::RenderedFrame& frame) {
            const py::gil_scoped_acquire acquire;
            deliver(frame.frame, frame.image, frame.volume);
        };
    return interruptibly([&](const std::stop_token& stop) {
        const DevicesInUse in_use(devices, stop);
        return voxelume::to_json(
            voxelume::render_frames(scene, in_use.list(), job, options.with(stop)));
    });
}

py::dict plan(const Scene& scene, const OpenDevice& open) {
    voxelume::Plan planned;
    {
        const py::gil_scoped_release release;
        planned = voxelume::plan(scene, open.device);
    }
    py::object refusal = py::none();
    if (planned.refusal) refusal = py::str(planned.refusal->what());
    return py::dict(
        py::arg("verdict") = voxelume::name_of(planned.verdict), py::arg("refusal") = refusal,
        py::arg("frame") = planned.frame, py::arg("chosen_frames") = planned.chosen_frames,
        py::arg("min_bytes") = planned.min_bytes, py::arg("max_bytes") = planned.max_bytes,
        py::arg("device_bytes") = planned.device_bytes, py::arg("host_bytes") = planned.host_bytes,
        py::arg("process_bytes") = planned.process_bytes);
}

}  // namespace

void bind_rendering(py::module_& module) {
    py::class_<Options>(module, "Options", "What rendering takes besides scene and devices.")
        .def(py::init(&options_of), py::arg("channels"), py::arg("progress"), py::arg("warn"),
             py::arg("strict"), py::arg("cache"));
    module.def("render_image", &render_image, py::arg("scene"), py::arg("devices"),
               py::arg("frame"), py::arg("options"), "Renders the image of a frame.");
    module.def("render_volume", &render_volume, py::arg("scene"), py::arg("devices"),
               py::arg("frame"), py::arg("options"), "Renders the volumetric image of a frame.");
    module.def(
        "render_frames",
        [](const Scene& scene, const std::vector<OpenDevice>& devices,
           const std::vector<int>& frames, const std::vector<std::string>& images,
           const std::vector<std::string>& volumes, const py::object& deliver, bool wants_images,
           bool wants_volumes, const Options& options) {
            voxelume::FrameJob job = job_of(frames, images, volumes);
            job.image_files.channels = channels_named(options.channels);
            job.deliver_images = wants_images;
            job.deliver_volumes = wants_volumes;
            return render_frames(scene, devices, std::move(job), deliver, options);
        },
        py::arg("scene"), py::arg("devices"), py::arg("frames"), py::arg("images"),
        py::arg("volumes"), py::arg("deliver"), py::arg("wants_images"), py::arg("wants_volumes"),
        py::arg("options"), "Renders frames; the statistics as JSON.");
    module.def("plan", &plan, py::arg("scene"), py::arg("device"),
               "What rendering the scene takes of a device.");
}

}  // namespace voxelume_python
