// Kernels compiled for a device, and their launches.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/opencl/kernel_source.hpp"

namespace voxelume {

/// What changes the machine code of a program: names and values of its -D constants.
using Defines = std::vector<std::pair<std::string, int>>;

/// How much one work-item does, which decides the work-group size.
enum class WorkItem {
    light,  ///< up to a few hundred operations: grouped, so that a CPU's launch cost is shared
    heavy,  ///< a packet of rays, a brick: one work-item is a work-group on a CPU
};

/// One kernel of a program. `launch` enqueues; it does not wait.
class Kernel {
  public:
    Kernel(Device device, std::shared_ptr<cl::Kernel> kernel, std::string name)
        : device_(std::move(device)), kernel_(std::move(kernel)), name_(std::move(name)) {}

    /// Runs `count` work-items, numbered by `work_item()` of lib/lanes/work_item.h, on these
    /// arguments.
    ///
    /// The kernel must return at once when its number is `count` or more; pass the count to it.
    /// Arguments are buffers, and values of exactly the kernel's parameter types.
    template <class... Args>
    void launch(WorkItem work, size_t count, const Args&... args) {
        uint32_t index = 0;
        (set_argument(index++, args), ...);
        enqueue(work, count);
    }

    /// Runs packets of the device's lanes for `rays` rays: the work-items of a packet kernel.
    template <class... Args>
    void launch_packets(size_t rays, const Args&... args) {
        const size_t lanes = static_cast<size_t>(device_.lanes());
        launch(WorkItem::heavy, (rays + lanes - 1) / lanes, args...);
    }

  private:
    template <class T>
    void set_argument(uint32_t index, const Buffer<T>& buffer) {
        set_buffer(index, buffer.storage());
    }
    template <class T>
    requires std::is_trivially_copyable_v<T>
    void set_argument(uint32_t index, const T& value) { set_bytes(index, sizeof(T), &value); }
    void set_buffer(uint32_t index, const BufferStorage* buffer);
    void set_bytes(uint32_t index, size_t bytes, const void* value);
    void enqueue(WorkItem work, size_t count);

    Device device_;
    std::shared_ptr<cl::Kernel> kernel_;
    std::string name_;
};

/// A kernel file compiled for a device with its constants; VXL_LANES is always among them.
class Program {
  public:
    /// Compiles kernels/`file` (e.g. "trace.cl"). Throws Error::build with the compiler's log.
    Program(const Device& device, const std::string& file, const Defines& defines = {});

    /// Compiles those of several files that weren't with these constants before into one program;
    /// whoever asks for one of them with these constants, as long as the device is open, gets that.
    /// Names of functions may be used once in all.
    static void build_together(const Device& device, std::span<const char* const> files,
                               const Defines& defines);

    /// Compiles `source`, a text that may include kernels/ files. For tests of device functions.
    static Program from_text(const Device& device, const std::string& source,
                             const Defines& defines = {});

    Kernel kernel(const std::string& name) const;

  private:
    Program(const Device& device, const std::string& label, const KernelSource& source,
            const Defines& defines);

    Device device_;
    std::string label_;
    std::shared_ptr<cl::Program> program_;
};

}  // namespace voxelume
