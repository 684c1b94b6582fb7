// A device that can run kernels: found, described, chosen by the user, opened.
#pragma once

#include <CL/opencl.hpp>

#include <cstdint>
#include <map>
#include <memory>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

enum class DeviceKind { cpu, gpu, other };

/// What the OpenCL platform says of a device, and whether Voxelume can render on it.
struct DeviceInfo {
    int index = 0;  ///< position in `list_devices()`, which `--device N` takes
    DeviceKind kind = DeviceKind::other;
    std::string name, vendor, platform;
    std::string version;  ///< OpenCL version text
    std::string driver;
    uint64_t memory = 0;          ///< bytes
    uint64_t max_allocation = 0;  ///< bytes in one buffer
    int compute_units = 0;
    int lanes = 1;         ///< rays that one work-item of a packet kernel carries
    std::string unusable;  ///< why it can't render here; empty when it can
};

/// Every device of every platform; a platform that fails is passed over.
std::vector<DeviceInfo> list_devices();

/// What was done on a device since it was opened: the tests read it, and so does `--stats-json`.
struct DeviceCounters {
    std::map<std::string, uint64_t> launches;  ///< by kernel name
    std::map<std::string, uint64_t>
        allocated_bytes;  ///< by buffer name, summed over all allocations
    uint64_t bytes_in_use = 0;
    uint64_t peak_bytes = 0;
    uint64_t programs_built = 0;
};

/// An open device: one context and one in-order queue. Shared by the buffers and programs made on
/// it.
class Device {
  public:
    /// Opens the device that `selector` names: auto, cpu, gpu, an index, or part of a name.
    ///
    /// `lanes` overrides the number of lanes (1, 4, 8 or 16); 0 keeps the device's own.
    /// Throws Error::device when nothing fits, naming what is there or the package to install.
    static Device open(std::string_view selector = "auto", int lanes = 0);

    const DeviceInfo& info() const;
    int lanes() const { return info().lanes; }
    bool is_cpu() const { return info().kind == DeviceKind::cpu; }

    const cl::Context& context() const;
    const cl::Device& handle() const;
    cl::CommandQueue& queue() const;
    DeviceCounters& counters() const;

    /// Waits until everything enqueued so far is done. Throws Error::render when the device failed.
    void finish() const;

  private:
    struct State;
    explicit Device(std::shared_ptr<State> state) : state_(std::move(state)) {}
    std::shared_ptr<State> state_;
};

/// The library's error for an OpenCL failure while doing `what` on a device.
[[noreturn]] void throw_device_error(const cl::Error& error, const DeviceInfo& info,
                                     std::string_view what);

}  // namespace voxelume
