#include "runtime/opencl/device.hpp"

#include <cstdlib>
#include <utility>

#include "runtime/error.hpp"
#include "runtime/opencl/platforms.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

constexpr size_t kTimesKept = 256;  // events waiting to be read; each holds driver memory

std::string environment(const char* name) {
    const char* value = std::getenv(name);
    return value ? value : "";
}

/// The lanes asked for by the caller, else by VOXELUME_LANES, else the device's own.
int lanes_for(const DeviceInfo& info, int asked) {
    const std::string text = asked != 0 ? std::to_string(asked) : environment("VOXELUME_LANES");
    if (text.empty()) return info.lanes;
    for (const int lanes : {1, 4, 8, 16})
        if (text == std::to_string(lanes)) return lanes;
    throw Error(ErrorKind::usage, "{} lanes per work-item: there are kernels for 1, 4, 8 and 16",
                text);
}

}  // namespace

struct Device::State {
    cl::Device device;
    DeviceInfo info;
    cl::Context context;
    cl::CommandQueue queue;
    DeviceCounters counters;
    std::map<std::string, cl::Program> programs;
    bool timing = false;
    std::vector<std::pair<std::string, cl::Event>> timed;  ///< launches whose time isn't added yet

    State() = default;
    State(const State&) = delete;
    State& operator=(const State&) = delete;
    ~State();
    void add_times();
};

/// Kernels are kept once nothing runs any more: PoCL compiles them at their first launch.
Device::State::~State() {
    if (queue() && clFinish(queue()) == CL_SUCCESS) keep_compiled_kernels(info);
}

void Device::State::add_times() {
    for (const auto& [kernel, event] : timed) {
        const cl_ulong start = event.getProfilingInfo<CL_PROFILING_COMMAND_START>();
        const cl_ulong end = event.getProfilingInfo<CL_PROFILING_COMMAND_END>();
        counters.kernel_ms[kernel] += double(end - start) / 1e6;
    }
    timed.clear();
}

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> infos;
    for (Candidate& candidate : find_candidates()) infos.push_back(std::move(candidate.info));
    return infos;
}

Device Device::open(std::string_view selector, int lanes) {
    const std::string by_default = environment("VOXELUME_DEVICE");
    if (selector.empty()) selector = by_default;
    if (selector.empty()) selector = "auto";
    const std::vector<Candidate> candidates = find_candidates();
    const Candidate& chosen = choose(candidates, selector);

    auto state = std::make_shared<State>();
    state->device = chosen.device;
    state->info = chosen.info;
    state->info.lanes = lanes_for(chosen.info, lanes);
    try {
        state->context = cl::Context(state->device);
        state->queue = cl::CommandQueue(state->context, state->device);
    } catch (const cl::Error& error) {
        throw_device_error(error, state->info, "opening it");
    }
    return Device(std::move(state));
}

const DeviceInfo& Device::info() const {
    return state_->info;
}
const cl::Context& Device::context() const {
    return state_->context;
}
const cl::Device& Device::handle() const {
    return state_->device;
}
cl::CommandQueue& Device::queue() const {
    return state_->queue;
}
DeviceCounters& Device::counters() const {
    return state_->counters;
}
std::map<std::string, cl::Program>& Device::programs() const {
    return state_->programs;
}

void Device::finish() const {
    try {
        state_->queue.finish();
        state_->add_times();
    } catch (const cl::Error& error) {
        throw_device_error(error, state_->info, "waiting for its kernels");
    }
}

void Device::time_kernels(bool on) const {
    finish();
    try {
        state_->queue =
            cl::CommandQueue(state_->context, state_->device, on ? CL_QUEUE_PROFILING_ENABLE : 0);
    } catch (const cl::Error& error) {
        throw_device_error(error, state_->info, "opening a queue");
    }
    state_->timing = on;
}

void Device::enqueue(const cl::Kernel& kernel, const std::string& name, const cl::NDRange& items,
                     const cl::NDRange& group) const {
    try {
        cl::Event event;
        state_->queue.enqueueNDRangeKernel(kernel, cl::NullRange, items, group, nullptr,
                                           state_->timing ? &event : nullptr);
        if (state_->timing) state_->timed.emplace_back(name, std::move(event));
    } catch (const cl::Error& error) {
        throw_device_error(error, state_->info, "launching " + name);
    }
    ++state_->counters.launches[name];
    if (state_->timed.size() >= kTimesKept) finish();
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
