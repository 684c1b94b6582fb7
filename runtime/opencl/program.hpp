// SPDX-License-Identifier: Apache-2.0
// Kernels compiled for a device, and how they are launched.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <type_traits>
#include <utility>
#include <vector>

#include "runtime/opencl/buffer.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/opencl/source/kernel_source.hpp"

namespace voxelume {

struct ProgramParts;

/// The names and values of a program's -D constants, which change its machine code.
using Defines = std::vector<std::pair<std::string, int>>;

/// The amount of work of one work-item, which decides the work-group size.
enum class WorkItem {
    light,  ///< up to a few hundred operations: grouped, so that a CPU's launch cost is shared
    heavy,  ///< a packet of rays, a brick: one work-item is a work-group on a CPU
};

/// The kernel-side name of type T; empty for structs and vectors.
template <class T>
constexpr std::string_view kernel_type() {
    if (std::is_same_v<T, float>) return "float";
    if (std::is_same_v<T, int8_t>) return "char";
    if (std::is_same_v<T, uint8_t>) return "uchar";
    if (std::is_same_v<T, int16_t>) return "short";
    if (std::is_same_v<T, uint16_t>) return "ushort";
    if (std::is_same_v<T, int32_t>) return "int";
    if (std::is_same_v<T, uint32_t>) return "uint";
    if (std::is_same_v<T, int64_t>) return "long";
    if (std::is_same_v<T, uint64_t>) return "ulong";
    return {};
}

/// A buffer of any 32-bit values for a kernel that moves them as words: `uint*`.
template <class T>
struct Words {
    explicit Words(const Buffer<T>& values) : buffer(values) { static_assert(sizeof(T) == 4); }
    const Buffer<T>& buffer;
};

class KernelArguments;

/// One kernel of a program. `launch` only enqueues; it waits for nothing but the compiler.
class Kernel {
  public:
    /// Runs `count` work-items, numbered by `work_item()` of lib/lanes/work_item.h, with these
    /// arguments.
    ///
    /// The kernel must return at once when its number is `count` or more; pass the count to it.
    /// Arguments are buffers, values of exactly the kernel's parameter types, and structures that
    /// KernelArguments knows. Throws Error::render, naming the kernel and the argument, for a
    /// number or types of arguments that the kernel doesn't have.
    template <class... Args>
    void launch(WorkItem work, size_t count, const Args&... args);

    /// Runs as many packets of the device's lanes as `rays` rays need: the work-items of a packet
    /// kernel.
    template <class... Args>
    void launch_packets(size_t rays, const Args&... args) {
        const size_t lanes = static_cast<size_t>(device_.lanes());
        launch(WorkItem::heavy, (rays + lanes - 1) / lanes, args...);
    }

  private:
    friend class KernelArguments;
    friend class Program;
    struct Made;

    Kernel(Device device, std::string name, std::shared_ptr<Made> made);
    /// Makes the kernel once it is compiled. Throws as Program::kernel does.
    const Made& made() const;
    void check_type(uint32_t index, bool is_buffer, std::string_view type) const;
    void check_count(uint32_t count) const;
    void set_buffer(uint32_t index, const BufferStorage* buffer);
    void set_bytes(uint32_t index, size_t bytes, const void* value);
    void enqueue(WorkItem work, size_t count);

    Device device_;
    std::string name_;
    std::shared_ptr<Made> made_;
};

/// The arguments of one launch, set in the order of the kernel's parameters.
///
/// A structure that kernels take whole has a function `bind(KernelArguments&, const Structure&)`
/// and a macro of parameters in kernels/lib. A new buffer of the structure is added to both, at the
/// same position.
class KernelArguments {
  public:
    explicit KernelArguments(Kernel& kernel) : kernel_(kernel) {}

    template <class... Args>
    void add(const Args&... args) {
        (add_one(args), ...);
    }
    uint32_t count() const { return count_; }

  private:
    template <class T>
    void add_one(const Buffer<T>& buffer) {
        kernel_.check_type(count_, true, kernel_type<T>());
        kernel_.set_buffer(count_++, buffer.storage());
    }
    template <class T>
    void add_one(const Words<T>& words) {
        kernel_.check_type(count_, true, kernel_type<uint32_t>());
        kernel_.set_buffer(count_++, words.buffer.storage());
    }
    template <class T>
    void add_one(const T& value) {
        if constexpr (requires { bind(*this, value); }) {
            bind(*this, value);
        } else {
            static_assert(std::is_trivially_copyable_v<T>);
            kernel_.check_type(count_, false, kernel_type<T>());
            kernel_.set_bytes(count_++, sizeof(T), &value);
        }
    }

    Kernel& kernel_;
    uint32_t count_ = 0;
};

template <class... Args>
void Kernel::launch(WorkItem work, size_t count, const Args&... args) {
    KernelArguments arguments(*this);
    arguments.add(args...);
    check_count(arguments.count());
    enqueue(work, count);
}

/// A kernel file and its constants.
struct ProgramFile {
    const char* file;
    Defines defines;
};

/// A kernel that will be launched, and the work of its work-items.
struct ForeseenKernel {
    const char* name;
    WorkItem work = WorkItem::heavy;
};

/// Kernel files that will be built together with these constants, and the kernels to be launched.
struct ForeseenProgram {
    std::vector<const char*> files;
    Defines defines;
    std::vector<ForeseenKernel> kernels;
};

/// A kernel file compiled for a device with its constants, among which VXL_LANES always is.
class Program {
  public:
    /// Compiles kernels/`file` (e.g. "trace.cl"). Throws Error::build with the compiler's log.
    Program(const Device& device, const std::string& file, const Defines& defines = {});

    /// Compiles several files into one program, without those that were compiled with these
    /// constants before. As long as the device is open, a Program of one of them with these
    /// constants uses that program. A function's name may be defined only once in all files.
    static void build_together(const Device& device, std::span<const char* const> files,
                               const Defines& defines);

    /// Compiles files with constants of their own as one program, which is faster: each program
    /// takes PoCL some 13 ms, whatever its size. Does nothing where a constant of one file would
    /// change another file.
    static void build_together(const Device& device, std::span<const ProgramFile> files);

    /// Makes a program that will be built later ready in another thread if an earlier run compiled
    /// it. If none did, lets helper processes compile it, where KernelCompilers is allowed any and
    /// PoCL compiles kernels.
    static void foresee(const Device& device, const ForeseenProgram& program);

    /// Compiles `source`, a text that may include kernels/ files. Used by tests of device
    /// functions.
    static Program from_text(const Device& device, const std::string& source,
                             const Defines& defines = {});

    /// Returns the kernel. Throws Error::build if there is none of this name. Where kernels are
    /// compiled alone, errors of its compiler are thrown when it is launched.
    Kernel kernel(const std::string& name) const;

  private:
    Program(const Device& device, const std::string& label, const KernelSource& source,
            const Defines& defines);
    Kernel kernel_of_parts(const std::string& name) const;

    Device device_;
    std::string label_;
    std::shared_ptr<cl::Program> program_;
    std::shared_ptr<const ProgramParts> parts_;  ///< used where kernels are compiled alone
};

}  // namespace voxelume
