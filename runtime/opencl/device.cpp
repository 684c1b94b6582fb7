// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/device.hpp"

#include <CL/opencl.hpp>

#include <atomic>
#include <limits>
#include <mutex>
#include <set>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/opencl/device_call.hpp"
#include "runtime/opencl/device_settings.hpp"
#include "runtime/opencl/kernel_builds.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

constexpr size_t kTimesKept = 256;  // events that wait to be read; each holds driver memory

/// The part of a device with VOXELUME_UNITS compute units, or all of it if that isn't set.
cl::Device part_of(const cl::Device& device) {
    const int units = units_to_use();
    if (units == 0) return device;
    const cl_device_partition_property properties[] = {CL_DEVICE_PARTITION_BY_COUNTS, units,
                                                       CL_DEVICE_PARTITION_BY_COUNTS_LIST_END, 0};
    std::vector<cl::Device> parts;
    try {
        cl::Device(device).createSubDevices(properties, &parts);
    } catch (const cl::Error& error) {
        throw Error(ErrorKind::device,
                    "\"{}\" gives no part of {} compute units ({}); unset VOXELUME_UNITS",
                    device.getInfo<CL_DEVICE_NAME>(), units, status_name(error.err()));
    }
    return parts.at(0);
}

}  // namespace

/// The programs of a context, by a hash of their sources and options.
struct ContextPrograms {
    std::mutex mutex;
    std::map<std::string, cl::Program> ready;
    KernelBuilds builds;
};

/// The state that all queues of an open device share.
struct Device::Opened {
    cl::Device device;
    DeviceInfo info;
    cl::Context context;
    std::shared_ptr<ContextPrograms> of_context = std::make_shared<ContextPrograms>();
    DeviceCounters counters;
    std::map<std::string, cl::Program> programs;
    std::mutex mutex;
    std::set<cl_program> fresh;             ///< programs that no earlier run compiled
    std::map<std::string, bool> compiling;  ///< their kernels; true if launched
    CompileListener compile_listener;
    std::mutex telling;  ///< held while the listener is called
    bool timing = false;
    std::atomic<uint32_t> batch_rays = kCpuBatchRays;
    bool has_run = false;      ///< has run to its end
    bool is_counting = false;  ///< counts only, without a device

    Opened() = default;
    Opened(const Opened&) = delete;
    Opened& operator=(const Opened&) = delete;
    ~Opened() {
        // Kernels are kept now, after all work is done, since PoCL compiles them at their first
        // launch.
        if (has_run) keep_compiled_kernels(info);
    }
};

struct Device::Queue {
    std::shared_ptr<Opened> opened;
    cl::CommandQueue queue;
    std::vector<std::pair<std::string, cl::Event>> timed;  ///< launches whose time isn't added yet

    explicit Queue(std::shared_ptr<Opened> device) : opened(std::move(device)) {
        if (!opened->is_counting) renew();
    }
    Queue(const Queue&) = delete;
    Queue& operator=(const Queue&) = delete;
    ~Queue() {
        if (queue()) opened->has_run = clFinish(queue()) == CL_SUCCESS;
    }

    void renew() {
        try {
            queue = cl::CommandQueue(opened->context, opened->device,
                                     opened->timing ? CL_QUEUE_PROFILING_ENABLE : 0);
        } catch (const cl::Error& error) {
            throw_device_error(error, opened->info, "opening a queue");
        }
    }

    void add_times() {
        const std::lock_guard lock(opened->mutex);
        for (const auto& [kernel, event] : timed) {
            const cl_ulong start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
            const cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
            opened->counters.kernel_ms[kernel] += double(end - start) / 1e6;
        }
        timed.clear();
    }
};

Device Device::open(const cl::Device& device, DeviceInfo info, const Device* sibling) {
    auto opened = std::make_shared<Opened>();
    opened->info = std::move(info);
    opened->batch_rays = opened->info.batch_rays;
    try {
        opened->device = part_of(device);
        const bool shares = sibling && sibling->handle()() == opened->device();
        opened->context = shares ? sibling->context() : cl::Context(opened->device);
        if (shares) opened->of_context = sibling->queue_->opened->of_context;
    } catch (const cl::Error& error) {
        throw_device_error(error, opened->info, "opening it");
    }
    return Device(std::make_shared<Queue>(std::move(opened)));
}

Device Device::counting(DeviceInfo info) {
    auto opened = std::make_shared<Opened>();
    opened->info = std::move(info);
    opened->batch_rays = opened->info.batch_rays;
    opened->info.memory = opened->info.max_allocation = std::numeric_limits<uint64_t>::max();
    opened->is_counting = true;
    return Device(std::make_shared<Queue>(std::move(opened)));
}

Device Device::with_own_queue() const {
    return Device(std::make_shared<Queue>(queue_->opened));
}

const DeviceInfo& Device::info() const {
    return queue_->opened->info;
}

uint32_t Device::batch_rays() const {
    return queue_->opened->batch_rays;
}

bool Device::use_smaller_batches() const {
    const auto locked = lock();
    constexpr uint32_t kMinRays = 1u << 12;  // whose buffers take a few megabytes at most
    const uint32_t rays = queue_->opened->batch_rays;
    if (rays < 2 * kMinRays) return false;
    queue_->opened->batch_rays = rays / 2;
    return true;
}

bool Device::is_counting() const {
    return queue_->opened->is_counting;
}
const cl::Context& Device::context() const {
    return queue_->opened->context;
}
const cl::Device& Device::handle() const {
    return queue_->opened->device;
}
cl::CommandQueue& Device::queue() const {
    return queue_->queue;
}
DeviceCounters& Device::counters() const {
    return queue_->opened->counters;
}
std::unique_lock<std::mutex> Device::lock() const {
    return std::unique_lock(queue_->opened->mutex);
}
const std::map<std::string, cl::Program>& Device::programs() const {
    return queue_->opened->programs;
}

cl::Program Device::find_program(const std::string& key) const {
    Opened& opened = *queue_->opened;
    if (const auto own = opened.programs.find(key); own != opened.programs.end())
        return own->second;
    const std::lock_guard locked(opened.of_context->mutex);
    const auto found = opened.of_context->ready.find(key);
    if (found == opened.of_context->ready.end()) return {};
    ++opened.counters.programs_built;
    ++opened.counters.programs_from_cache;
    return opened.programs[key] = found->second;
}

void Device::keep_program(const std::string& key, const cl::Program& program) const {
    queue_->opened->programs[key] = program;
    const std::lock_guard locked(queue_->opened->of_context->mutex);
    queue_->opened->of_context->ready[key] = program;
}

void Device::finish() const {
    static const std::string kWhat = "waiting for its kernels";
    try {
        const DeviceCall call(info(), "", kWhat);
        queue_->queue.finish();
        queue_->add_times();
    } catch (const cl::Error& error) {
        throw_device_error(error, info(), kWhat);
    }
}

void Device::time_kernels(bool on) const {
    finish();
    queue_->opened->timing = on;
    queue_->renew();
}

void Device::listen_to_compiler(CompileListener listener) const {
    const std::scoped_lock locked(queue_->opened->telling, queue_->opened->mutex);
    queue_->opened->compile_listener = std::move(listener);
}

void Device::note_fresh(const cl::Program& program) const {
    queue_->opened->fresh.insert(program());
}

void Device::note_kernel(const cl::Program& program, const std::string& kernel) const {
    const auto locked = lock();
    if (queue_->opened->fresh.contains(program())) queue_->opened->compiling.emplace(kernel, false);
}

void Device::note_wait(const std::string& kernel) const {
    {
        const auto locked = lock();
        queue_->opened->compiling.emplace(kernel, false);
    }
    tell_compiling(kernel);
}

KernelBuilds& Device::kernel_builds() const {
    return queue_->opened->of_context->builds;
}

void Device::tell_compiling(const std::string& kernel) const {
    Opened& opened = *queue_->opened;
    int known = 0, launched = 0;
    {
        const auto locked = lock();
        const auto found = opened.compiling.find(kernel);
        if (found == opened.compiling.end() || std::exchange(found->second, true)) return;
        known = int(opened.compiling.size());
        for (const auto& [name, was_launched] : opened.compiling) launched += int(was_launched);
    }
    const std::lock_guard telling(opened.telling);
    if (opened.compile_listener) opened.compile_listener(launched, known);
}

void Device::enqueue(const cl::Kernel& kernel, const std::string& name, const cl::NDRange& items,
                     const cl::NDRange& group) const {
    const bool timing = queue_->opened->timing;
    tell_compiling(name);
    try {
        const DeviceCall call(info(), "launching ", name);
        cl::Event event;
        queue_->queue.enqueueNDRangeKernel(kernel, cl::NullRange, items, group, nullptr,
                                           timing ? &event : nullptr);
        if (timing) queue_->timed.emplace_back(name, std::move(event));
    } catch (const cl::Error& error) {
        throw_device_error(error, info(), "launching " + name);
    }
    {
        const auto locked = lock();
        ++counters().launches[name];
    }
    if (queue_->timed.size() >= kTimesKept) finish();
}

void throw_device_error(const cl::Error& error, const DeviceInfo& info, std::string_view what) {
    if (is_out_of_memory(error.err()))
        throw Error(ErrorKind::limit,
                    "\"{}\" ran out of memory while {} ({} returned {}): use larger voxels or a "
                    "smaller image",
                    info.name, what, error.what(), status_name(error.err()));
    throw Error(ErrorKind::render, "\"{}\" failed while {}: {} returned {}", info.name, what,
                error.what(), status_name(error.err()));
}

}  // namespace voxelume
