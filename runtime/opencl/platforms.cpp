// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/platforms.hpp"

#include <fmt/format.h>

#include <algorithm>

#include "runtime/base/error.hpp"
#include "runtime/opencl/quirks/driver_quirks.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"
#include "runtime/opencl/ranking.hpp"
#include "runtime/opencl/selector.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

std::string trimmed(std::string text) {
    while (!text.empty() && (text.back() == '\0' || text.back() == ' ')) text.pop_back();
    return text;
}

DeviceKind kind_of(const cl::Device& device) {
    const cl_device_type type = device.getInfo<CL_DEVICE_TYPE>();
    if (type & CL_DEVICE_TYPE_GPU) return DeviceKind::gpu;
    return type & CL_DEVICE_TYPE_CPU ? DeviceKind::cpu : DeviceKind::other;
}

/// The lanes that one work-item handles. A CPU's vector registers hold 16, 8 or 4 floats; a GPU
/// gives every ray a work-item of its own.
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
    return missing_ability(kind_of(device), device.getInfo<CL_DEVICE_VERSION>(),
                           device.getInfo<CL_DEVICE_MAX_WORK_GROUP_SIZE>());
}

/// The PCI address of a card, by the extension cl_khr_pci_bus_info.
std::string card_of(const cl::Device& device) {
    constexpr cl_device_info kPciBusInfo = 0x410F;
    struct {
        cl_uint domain, bus, device, function;
    } address{};
    size_t bytes = 0;
    if (clGetDeviceInfo(device(), kPciBusInfo, sizeof address, &address, &bytes) != CL_SUCCESS ||
        bytes != sizeof address)
        return {};
    return fmt::format("{:04x}:{:02x}:{:02x}.{:x}", address.domain, address.bus, address.device,
                       address.function);
}

std::string note_on(const DeviceInfo& info) {
    const DriverQuirks& quirks = driver_quirks(info.platform);
    const bool is_generic =
        !quirks.generic_name.empty() && info.name.find(quirks.generic_name) != std::string::npos;
    return std::string(is_generic ? quirks.note_on_generic : "");
}

DeviceInfo describe(const cl::Platform& platform, const cl::Device& device) {
    DeviceInfo info;
    info.kind = kind_of(device);
    info.name = trimmed(device.getInfo<CL_DEVICE_NAME>());
    info.vendor = trimmed(device.getInfo<CL_DEVICE_VENDOR>());
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.platform_version = trimmed(platform.getInfo<CL_PLATFORM_VERSION>());
    info.version = trimmed(device.getInfo<CL_DEVICE_VERSION>());
    info.driver = trimmed(device.getInfo<CL_DRIVER_VERSION>());
    info.memory = device.getInfo<CL_DEVICE_GLOBAL_MEM_SIZE>();
    info.max_allocation = device.getInfo<CL_DEVICE_MAX_MEM_ALLOC_SIZE>();
    info.compute_units = static_cast<int>(device.getInfo<CL_DEVICE_MAX_COMPUTE_UNITS>());
    info.clock = static_cast<int>(device.getInfo<CL_DEVICE_MAX_CLOCK_FREQUENCY>());
    info.shares_memory = device.getInfo<CL_DEVICE_HOST_UNIFIED_MEMORY>() != 0;
    info.card = card_of(device);
    info.lanes = lanes_of(device, info.kind);
    info.unusable = reason_unusable(device);
    info.note = note_on(info);
    return info;
}

/// The entry for a device that doesn't answer queries.
DeviceInfo silent_device(const cl::Platform& platform, const cl::Error& error) {
    DeviceInfo info;
    info.name = "a device that does not answer";
    info.platform = trimmed(platform.getInfo<CL_PLATFORM_NAME>());
    info.unusable = fmt::format("{} returned {}", error.what(), status_name(error.err()));
    return info;
}

void append_devices(const cl::Platform& platform, std::vector<Candidate>& found) {
    std::vector<cl::Device> devices;
    platform.getDevices(CL_DEVICE_TYPE_ALL, &devices);
    for (const cl::Device& device : devices) {
        try {
            found.push_back({device, describe(platform, device)});
        } catch (const cl::Error& error) {
            found.push_back({device, silent_device(platform, error)});
        }
    }
}

void append_platforms(std::vector<Candidate>& found) {
    std::vector<cl::Platform> platforms;
    try {
        cl::Platform::get(&platforms);
    } catch (const cl::Error&) {
        return;  // no driver installed at all (CL_PLATFORM_NOT_FOUND_KHR)
    }
    for (const cl::Platform& platform : platforms) {
        try {
            append_devices(platform, found);
        } catch (const cl::Error&) {
            continue;  // a broken or empty platform must not end the program
        }
    }
}

/// The parts of a CPU, each with its share of memory. They render exactly as the whole CPU does.
/// Compute units that remain after the division are idle.
std::vector<Candidate> parts_of(const Candidate& whole, int parts) {
    const int units = whole.info.compute_units / parts;
    if (units < 1)
        throw Error(ErrorKind::device, "\"{}\" has {} compute unit{}, too few for {} devices",
                    whole.info.name, whole.info.compute_units,
                    whole.info.compute_units == 1 ? "" : "s", parts);
    std::vector<cl::Device> devices;
    try {
        const cl_device_partition_property equally[] = {CL_DEVICE_PARTITION_EQUALLY, units, 0};
        cl::Device(whole.device).createSubDevices(equally, &devices);
    } catch (const cl::Error& error) {
        throw Error(ErrorKind::device, "\"{}\" can't be cut into {} devices: {} returned {}",
                    whole.info.name, parts, error.what(), status_name(error.err()));
    }
    std::vector<Candidate> found;
    for (int i = 0; i < parts; ++i) {
        found.push_back({devices.at(size_t(i)), whole.info});
        found.back().info.compute_units = units;
        found.back().info.memory /= uint64_t(parts);
        found.back().info.max_allocation =
            std::min(found.back().info.max_allocation, found.back().info.memory);
    }
    return found;
}

std::vector<DeviceInfo> infos_of(const std::vector<Candidate>& candidates) {
    std::vector<DeviceInfo> infos(candidates.size());
    std::ranges::transform(candidates, infos.begin(), &Candidate::info);
    return infos;
}

}  // namespace

std::vector<Candidate> find_candidates() {
    std::vector<Candidate> found;
    PoclFolder::instance().announce([&found] { append_platforms(found); });
    for (size_t i = 0; i < found.size(); ++i) found[i].info.index = static_cast<int>(i);
    return found;
}

const Candidate& choose(const std::vector<Candidate>& candidates, std::string_view selector) {
    return candidates[best_device(infos_of(candidates), selector)];
}

std::vector<Candidate> choose_all(const std::vector<Candidate>& candidates, int cpu_parts) {
    std::vector<Candidate> chosen;
    bool has_cpu = false;
    for (const Candidate& candidate : candidates)
        has_cpu |= candidate.info.kind == DeviceKind::cpu && is_usable(candidate.info);
    for (const size_t card : distinct_gpus(infos_of(candidates)))
        chosen.push_back(candidates[card]);
    // Two platforms' devices of one CPU would compete for its time.
    if (has_cpu) {
        const Candidate& cpu = choose(candidates, "cpu");
        const std::vector<Candidate> parts =
            cpu_parts > 1 ? parts_of(cpu, cpu_parts) : std::vector{cpu};
        chosen.insert(chosen.end(), parts.begin(), parts.end());
    }
    if (chosen.empty()) chosen.push_back(choose(candidates, "auto"));
    return chosen;
}

}  // namespace voxelume
