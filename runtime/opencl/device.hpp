// SPDX-License-Identifier: Apache-2.0
// A device that can run kernels: found, described, chosen by the user, opened.
#pragma once

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <mutex>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/opencl/handles.hpp"

namespace voxelume {

enum class DeviceKind { cpu, gpu, other };

/// The result of the self-test when a driver was first used: whether its bits were the known ones.
enum class SelfTest { unknown, passed, failed };

struct Candidate;
class KernelBuilds;

/// The largest batch of rays of a CPU.
inline constexpr uint32_t kCpuBatchRays = 1u << 17;

/// A device as its OpenCL platform describes it, and whether Voxelume can render on it.
struct DeviceInfo {
    int index = 0;  ///< position in `list_devices()`, which `--device N` takes
    DeviceKind kind = DeviceKind::other;
    std::string name, vendor, platform;
    std::string platform_version;
    std::string version;  ///< OpenCL version text
    std::string driver;
    uint64_t memory = 0;          ///< bytes
    uint64_t max_allocation = 0;  ///< bytes in one buffer
    int compute_units = 0;
    int clock = 0;               ///< MHz; 0 where the driver doesn't say
    bool shares_memory = false;  ///< with the host, as GPUs inside of processors do
    std::string card;  ///< the PCI address of its card, equal for all drivers; empty where unknown
    int lanes = 1;     ///< number of rays that one work-item of a packet kernel handles
    int work_group = 0;  ///< number of work-items in every group; 0: chosen by kernel and kind of
                         ///< device
    uint32_t batch_rays = kCpuBatchRays;  ///< the maximum number of rays that pass through the
                                          ///< stages together where memory suffices
    std::string build_options;            ///< added to the options of every program
    SelfTest self_test = SelfTest::unknown;
    std::string unusable;  ///< the reason why it can't render; empty if it can
    std::string note;      ///< a note for its user; mostly empty
};

/// Every device of every platform; a platform that fails is skipped. Their memory is what
/// Device::open lets programs use.
std::vector<DeviceInfo> list_devices();

/// The counts of a device's work since it was opened. Tests and `--stats-json` read them.
struct DeviceCounters {
    std::map<std::string, uint64_t> launches;  ///< by kernel name
    std::map<std::string, double> kernel_ms;   ///< by kernel name, while `time_kernels` is on
    std::map<std::string, uint64_t>
        allocated_bytes;  ///< by buffer name, summed over all allocations
    uint64_t bytes_in_use = 0;
    uint64_t peak_bytes = 0;
    uint64_t programs_built = 0;       ///< number of programs made ready, compiled or not
    uint64_t programs_from_cache = 0;  ///< number of those that weren't compiled again
    uint64_t programs_begun = 0;       ///< number of those made ready before they were needed
    double build_ms = 0;         ///< time for making programs ready; PoCL does most at first launch
    std::string largest_buffer;  ///< name of the largest buffer so far
    uint64_t largest_bytes = 0;
};

/// Called when a kernel is about to be compiled, number `kernel` of `known` such kernels so far.
using CompileListener = std::function<void(int kernel, int known)>;

/// An open device and an in-order queue of work for it. Buffers and programs made on it share it.
/// Each thread uses a queue of its own.
class Device {
  public:
    /// Opens the device that `selector` names: auto, cpu, gpu, an index of `list_devices()`, or
    /// part of the name of a device or its platform. An empty selector (no --device was given)
    /// means VOXELUME_DEVICE, or auto if that isn't set.
    ///
    /// If several devices match, the best of them by is_better() of ranking.hpp is opened. `lanes`
    /// overrides the lanes per work-item (1, 4, 8 or 16); 0 means VOXELUME_LANES, else the device's
    /// own. Uses at most VOXELUME_MEMORY_MB megabytes of the device's memory, and at most
    /// VOXELUME_BUFFER_MB in one buffer. For the search of drivers' faults, VOXELUME_WORK_GROUP
    /// sets the size of every work-group, VOXELUME_UNITS limits the compute units (a sub-device),
    /// VOXELUME_BATCH sets how many rays pass through the stages together, and
    /// VOXELUME_BUILD_OPTIONS is added to the compiler's options.
    ///
    /// When a driver is new, its device runs a self-test first, see self_test.hpp. A device that
    /// fails is refused like one that can't render: the next best match is opened instead.
    ///
    /// If the device is that of `sibling`, both share an OpenCL context and the programs made for
    /// it: PoCL reads its library of functions, 0.7 s, once for each context. Throws Error::device
    /// if nothing matches; the message names the devices that exist or the package to install.
    static Device open(std::string_view selector = {}, int lanes = 0,
                       const Device* sibling = nullptr);

    /// Opens all devices that share the work. For the selector `all` these are every GPU and the
    /// best CPU; for `all/N` the CPU is divided into N equal devices (one for each memory node of a
    /// large machine, for example); for any other selector it is the device that `open` opens.
    /// `open` treats `all` and `all/N` as auto. Throws Error::device as `open` does.
    static std::vector<Device> open_all(std::string_view selector = {}, int lanes = 0);

    /// A device without memory and queue, on which buffers are only counted: `counters()` tells the
    /// maximum that the stages that make and free buffers take. Nothing can be read from its
    /// buffers, nothing launched on it; its memory is unlimited.
    static Device counting(DeviceInfo info);

    /// Returns this device with another queue, for another thread. Its buffers, once written, serve
    /// kernels of both.
    Device with_own_queue() const;

    const DeviceInfo& info() const;
    /// The maximum number of rays that pass through the stages together from now on.
    uint32_t batch_rays() const;
    /// Halves batches for all that use this device, since it lacks memory. Returns false when they
    /// are small already, so that their buffers no longer matter.
    bool use_smaller_batches() const;
    int lanes() const { return info().lanes; }
    bool is_cpu() const { return info().kind == DeviceKind::cpu; }
    bool is_counting() const;

    const cl::Context& context() const;
    const cl::Device& handle() const;
    cl::CommandQueue& queue() const;
    DeviceCounters& counters() const;
    /// A lock to hold while counters or programs are changed.
    std::unique_lock<std::mutex> lock() const;
    /// The programs that this device has used, by a hash of their sources and options. They are
    /// kept until the device closes, since PoCL takes 20 ms to find a program on the disk: it
    /// preprocesses the source with its own headers of 1 MB.
    const std::map<std::string, cl::Program>& programs() const;
    /// The program of this hash, if this device or another one of its context has made it ready,
    /// else an empty one. The program then counts as made ready by this device, too. Call this
    /// function and keep_program with `lock` held.
    cl::Program find_program(const std::string& key) const;
    /// Keeps a program that was just built, for all devices of the context.
    void keep_program(const std::string& key, const cl::Program& program) const;

    /// Waits until all enqueued work is done. Throws Error::render if the device failed.
    void finish() const;

    /// Adds the time of every launch from here on to `counters().kernel_ms`, which is complete
    /// after `finish`.
    void time_kernels(bool on) const;

    /// Calls `listener`, by one thread at a time, before the first launch of each kernel whose
    /// program wasn't ready from an earlier run. PoCL compiles the kernel then; other drivers have
    /// compiled it when the program was built. An empty listener ends the calls.
    void listen_to_compiler(CompileListener listener) const;
    /// Notes a program that no earlier run compiled.
    void note_fresh(const cl::Program& program) const;
    /// Notes a kernel of a program, for which note_fresh() may have been called.
    void note_kernel(const cl::Program& program, const std::string& kernel) const;
    /// Notes that this kernel's first launch waits for its compiler, and tells the listener.
    void note_wait(const std::string& kernel) const;

    /// The kernels of the device's context that are compiled alone.
    KernelBuilds& kernel_builds() const;

    /// Enqueues a launch of `kernel`, which is named `name` in the counters.
    void enqueue(const cl::Kernel& kernel, const std::string& name, const cl::NDRange& items,
                 const cl::NDRange& group) const;

  private:
    struct Opened;
    struct Queue;
    static Device open(const cl::Device& device, DeviceInfo info, const Device* sibling);
    /// Empty if the driver's self-test found a fault.
    static std::optional<Device> open_tested(const Candidate& chosen, int lanes,
                                             const Device* sibling, std::string& fault);
    void tell_compiling(const std::string& kernel) const;
    explicit Device(std::shared_ptr<Queue> queue) : queue_(std::move(queue)) {}
    std::shared_ptr<Queue> queue_;
};

/// Throws the library's error for an OpenCL failure while doing `what` on a device.
[[noreturn]] void throw_device_error(const cl::Error& error, const DeviceInfo& info,
                                     std::string_view what);

}  // namespace voxelume
