#include "runtime/opencl/device.hpp"

#include <algorithm>
#include <charconv>
#include <cstdlib>

#include "runtime/error.hpp"

namespace voxelume {
namespace {

struct Candidate {
    cl::Device device;
    DeviceInfo info;
};

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

std::string trimmed(std::string text) {
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

/// Lanes that one work-item carries: a CPU's vector registers hold 16, 8 or 4 floats; a GPU gives
/// every ray a work-item of its own.
int lanes_of(const cl::Device& device, DeviceKind kind) {
    if (kind != DeviceKind::cpu) return 1;
    const cl_uint width = device.getInfo<CL_DEVICE_NATIVE_VECTOR_WIDTH_FLOAT>();
    return width >= 16 ? 16 : width >= 8 ? 8 : width >= 4 ? 4 : 1;
}

std::string reason_unusable(const cl::Device& device) {
    if (!device.getInfo<CL_DEVICE_AVAILABLE>()) return "the driver says it is not available";
    if (!device.getInfo<CL_DEVICE_COMPILER_AVAILABLE>()) return "it has no kernel compiler";
    if (!device.getInfo<CL_DEVICE_ENDIAN_LITTLE>()) return "it is big-endian";
    if (device.getInfo<CL_DEVICE_PROFILE>().starts_with("EMBEDDED"))
        return "it offers the embedded profile only, without 64-bit integers";
    return {};
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
    DeviceInfo info;
    const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
    info.kind = type & CL_DEVICE_TYPE_GPU   ? DeviceKind::gpu
                : type & CL_DEVICE_TYPE_CPU ? DeviceKind::cpu
                                            : DeviceKind::other;
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
    info.lanes = lanes_of(device, info.kind);
    info.unusable = reason_unusable(device);
    return info;
}

std::vector<Candidate> find_candidates() {
    std::vector<Candidate> found;
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return found;  // no driver installed at all (CL_PLATFORM_NOT_FOUND_KHR)
    }
    for (const cl::Platform& platform : platforms) {
        try {
            std::vector<cl::Device> devices;
            platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
            for (const cl::Device& device : devices)
                found.push_back({device, describe(platform, device)});
        } catch (const cl::Error&) {
            continue;  // a broken or empty platform must not end the program
        }
    }
    for (size_t i = 0; i < found.size(); ++i) found[i].info.index = static_cast<int>(i);
    return found;
}

bool matches(const DeviceInfo& info, const std::string& selector) {
    if (selector == "cpu") return info.kind == DeviceKind::cpu;
    if (selector == "gpu") return info.kind == DeviceKind::gpu;
    int index = -1;
    const auto [end, error] =
        std::from_chars(selector.data(), selector.data() + selector.size(), index);
    if (error == std::errc() && end == selector.data() + selector.size())
        return info.index == index;
    return lower(info.name).find(selector) != std::string::npos ||
           lower(info.platform).find(selector) != std::string::npos;
}

/// `auto` takes the device that most likely renders fastest: a GPU before a CPU, then compute
/// units.
bool better(const DeviceInfo& a, const DeviceInfo& b) {
    if ((a.kind == DeviceKind::gpu) != (b.kind == DeviceKind::gpu))
        return a.kind == DeviceKind::gpu;
    return a.compute_units > b.compute_units;
}

[[noreturn]] void throw_no_match(const std::vector<Candidate>& candidates,
                                 std::string_view selector) {
    if (candidates.empty())
        throw Error(ErrorKind::device,
                    "no OpenCL device found: install a driver, for a CPU the package "
                    "pocl-opencl-icd, or set OCL_ICD_VENDORS to the folder that names yours");
    std::string names;
    for (const Candidate& candidate : candidates) {
        names += fmt::format("{}[{}] {}", names.empty() ? "" : ", ", candidate.info.index,
                             candidate.info.name);
        if (!candidate.info.unusable.empty())
            names += fmt::format(" (not usable: {})", candidate.info.unusable);
    }
    throw Error(ErrorKind::device, "no usable device matches \"{}\"; there are: {}", selector,
                names);
}

}  // namespace

struct Device::State {
    cl::Device device;
    DeviceInfo info;
    cl::Context context;
    cl::CommandQueue queue;
    DeviceCounters counters;
};

std::vector<DeviceInfo> list_devices() {
    std::vector<DeviceInfo> infos;
    for (Candidate& candidate : find_candidates()) infos.push_back(std::move(candidate.info));
    return infos;
}

Device Device::open(std::string_view selector, int lanes) {
    const std::vector<Candidate> candidates = find_candidates();
    const std::string wanted = lower(selector);
    const Candidate* chosen = nullptr;
    for (const Candidate& candidate : candidates) {
        if (!candidate.info.unusable.empty()) continue;
        if (wanted != "auto" && !wanted.empty() && !matches(candidate.info, wanted)) continue;
        if (!chosen || better(candidate.info, chosen->info)) chosen = &candidate;
    }
    if (!chosen) throw_no_match(candidates, selector);

    auto state = std::make_shared<State>();
    state->device = chosen->device;
    state->info = chosen->info;
    if (lanes != 0) state->info.lanes = lanes;
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

void Device::finish() const {
    try {
        state_->queue.finish();
    } catch (const cl::Error& error) {
        throw_device_error(error, state_->info, "waiting for its kernels");
    }
}

void throw_device_error(const cl::Error& error, const DeviceInfo& info, std::string_view what) {
    const bool memory =
        error.err() == CL_MEM_OBJECT_ALLOCATION_FAILURE || error.err() == CL_OUT_OF_RESOURCES ||
        error.err() == CL_OUT_OF_HOST_MEMORY || error.err() == CL_INVALID_BUFFER_SIZE;
    if (memory)
        throw Error(ErrorKind::limit,
                    "\"{}\" ran out of memory while {} ({} failed with {}): use larger voxels or a "
                    "smaller image",
                    info.name, what, error.what(), error.err());
    throw Error(ErrorKind::render, "\"{}\" failed while {}: {} returned {}", info.name, what,
                error.what(), error.err());
}

}  // namespace voxelume
