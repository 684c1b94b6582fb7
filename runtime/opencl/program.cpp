// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/program.hpp"

#include <CL/opencl.hpp>

#include <algorithm>
#include <array>
#include <chrono>
#include <future>
#include <mutex>
#include <utility>

#include "runtime/base/error.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/opencl/build_log.hpp"
#include "runtime/opencl/kernel_builds.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/quirks/driver_quirks.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

/// Waits for a compiler shorter than this aren't reported.
constexpr std::chrono::milliseconds kUntoldWait(100);

/// The compiler's options, with only those constants that the source mentions. So scenes that
/// differ in other constants share compiled programs.
std::string build_options(const Device& device, const KernelSource& source, Defines defines) {
    // Without -w PoCL's compiler counts its warnings on stderr: on a CPU without AVX-512 there is
    // one for every function that takes sixteen numbers.
    std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info -w";
    if (std::ranges::find(defines, "VXL_LANES", &Defines::value_type::first) == defines.end())
        defines.emplace_back("VXL_LANES", device.lanes());
    std::ranges::sort(defines);  // the order doesn't matter to the program
    for (const auto& [name, value] : defines)
        if (source.mentions(name)) options += fmt::format(" -D{}={}", name, value);
    options += driver_quirks(device.info().platform).build_options;
    if (!device.info().build_options.empty()) options += " " + device.info().build_options;
    return options;
}

std::string program_key(const KernelSource& source, const std::string& options) {
    const std::array<std::string_view, 2> parts = {source.text(), options};
    return cache_key(parts);
}

std::string label_of(std::span<const char* const> files) {
    return fmt::format("kernels/{}", fmt::join(files, " with kernels/"));
}

size_t group_size(const Device& device, WorkItem work) {
    if (device.info().work_group > 0) return size_t(device.info().work_group);
    return device.is_cpu() ? (work == WorkItem::heavy ? 1 : 16) : 64;
}

/// Empty names where the driver keeps no types.
std::vector<std::string> parameter_types(const cl::Kernel& kernel) {
    std::vector<std::string> types(kernel.getInfo<CL_KERNEL_NUM_ARGS>());
    for (cl_uint i = 0; i < types.size(); ++i) {
        std::array<char, 64> name{};
        if (clGetKernelArgInfo(kernel(), i, CL_KERNEL_ARG_TYPE_NAME, name.size() - 1, name.data(),
                               nullptr) == CL_SUCCESS)
            types[i] = name.data();
    }
    return types;
}

/// "uint*" -> "uint".
std::string_view element_of(std::string_view type) {
    return type.substr(0, type.find('*'));
}

/// True for types of numbers: structs and vectors are often another view of the host's values.
bool is_number(std::string_view element) {
    constexpr std::string_view kNumbers[] = {"char", "uchar", "short", "ushort", "int",
                                             "uint", "long",  "ulong", "float"};
    return std::ranges::find(kNumbers, element) != std::end(kNumbers);
}

}  // namespace

/// An OpenCL kernel, which may still be compiling.
struct Kernel::Made {
    std::string label;  ///< its program's
    std::once_flag once;
    std::string key;                         ///< key of `build`
    std::shared_future<BuiltProgram> build;  ///< where it isn't ready
    cl::Program program;
    cl::Kernel kernel;
    std::vector<std::string> parameters;  ///< their types; empty where the driver doesn't tell

    /// Waits for the kernel's compiler, and keeps the program for others.
    void wait(const Device& device, const std::string& name);
    void make(const Device& device, const std::string& name);
};

void Kernel::Made::wait(const Device& device, const std::string& name) {
    const auto start = std::chrono::steady_clock::now();
    if (build.wait_for(kUntoldWait) != std::future_status::ready) device.note_wait(name);
    try {
        const BuiltProgram& built = build.get();
        program = *built.program;
        const auto locked = device.lock();
        if (device.find_program(key)()) return;  // others waited, too, and kept it
        device.keep_program(key, program);
        ++device.counters().programs_built;
        device.counters().programs_from_cache += uint64_t(built.is_from_cache);
        device.counters().build_ms +=
            std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start)
                .count();
    } catch (const Error& error) {
        fail_build(label, device.info(), error.what());
    } catch (const cl::Error& error) {
        throw_device_error(error, device.info(), "compiling " + label);
    }
}

void Kernel::Made::make(const Device& device, const std::string& name) {
    if (!program()) wait(device, name);
    try {
        kernel = cl::Kernel(program, name.c_str());
        parameters = parameter_types(kernel);
        device.note_kernel(program, name);
    } catch (const cl::Error& error) {
        if (error.err() == CL_INVALID_KERNEL_NAME)
            throw Error(ErrorKind::build, "{} has no kernel {} on \"{}\" ({})", label, name,
                        device.info().name, status_name(error.err()));
        throw_device_error(error, device.info(), fmt::format("making {} of {}", name, label));
    }
}

Kernel::Kernel(Device device, std::string name, std::shared_ptr<Made> made)
    : device_(std::move(device)), name_(std::move(name)), made_(std::move(made)) {}

const Kernel::Made& Kernel::made() const {
    std::call_once(made_->once, [&] { made_->make(device_, name_); });
    return *made_;
}

void Kernel::check_type(uint32_t index, bool is_buffer, std::string_view type) const {
    const std::vector<std::string>& parameters = made().parameters;
    if (index >= parameters.size()) check_count(index + 1);
    const std::string_view parameter = parameters[index];
    if (parameter.empty()) return;
    const std::string_view element = element_of(parameter);
    const bool fits = type.empty() || !is_number(element) || element == type;
    if (fits && is_buffer == parameter.ends_with('*')) return;
    throw Error(ErrorKind::render, "kernel {}: argument {} is {}{}, but the parameter is {}", name_,
                index, is_buffer ? "a buffer of " : "a value of type ",
                type.empty() ? "a struct or vector" : type, parameter);
}

void Kernel::check_count(uint32_t count) const {
    const size_t parameters = made().parameters.size();
    if (count == parameters) return;
    throw Error(ErrorKind::render, "kernel {} has {} parameters, but gets {}{} arguments", name_,
                parameters, count > parameters ? "at least " : "", count);
}

void Kernel::set_buffer(uint32_t index, const BufferStorage* buffer) {
    const cl_mem memory = buffer ? buffer->handle()() : nullptr;
    set_bytes(index, sizeof(cl_mem), &memory);
}

void Kernel::set_bytes(uint32_t index, size_t bytes, const void* value) {
    const cl_int status = clSetKernelArg(made().kernel(), index, bytes, value);
    if (status != CL_SUCCESS)
        throw_device_error(
            cl::Error(status, "clSetKernelArg"), device_.info(),
            fmt::format("setting argument {} of {} bytes of {}", index, bytes, name_));
}

void Kernel::enqueue(WorkItem work, size_t count) {
    if (count == 0) return;
    // The local size is fixed per kernel, and both dimensions are below 65535: PoCL compiles a
    // kernel again for every other local size, and for any larger dimension.
    const size_t local = group_size(device_, work);
    const size_t row_items = 16384 / local * local;
    const size_t groups = (count + local - 1) / local;
    const size_t columns = std::min(groups * local, row_items);
    const size_t rows = (groups * local + columns - 1) / columns;
    device_.enqueue(made().kernel, name_, cl::NDRange(columns, rows), cl::NDRange(local, 1));
}

Program::Program(const Device& device, const std::string& file, const Defines& defines)
    : Program(device, "kernels/" + file, kernel_source(file), defines) {}

void Program::build_together(const Device& device, std::span<const char* const> files,
                             const Defines& defines) {
    if (compiles_kernels_alone(device.info())) return;
    std::vector<std::string> keys;
    std::vector<const char*> missing;
    const auto locked = device.lock();
    for (const char* file : files) {
        const KernelSource& source = kernel_source(file);
        const std::string options = build_options(device, source, defines);
        std::string key = program_key(source, options);
        if (device.find_program(key)()) continue;
        keys.push_back(std::move(key));
        missing.push_back(file);
    }
    if (missing.empty()) return;
    const KernelSource source = kernel_source(missing);
    const cl::Program program = build_program(
        device, label_of(missing), {source.text(), build_options(device, source, defines)});
    for (const std::string& key : keys) device.keep_program(key, program);
}

void Program::build_together(const Device& device, std::span<const ProgramFile> files) {
    if (device.is_counting() || compiles_kernels_alone(device.info())) return;
    std::vector<const char*> names;
    Defines all;
    for (const auto& [file, defines] : files) {
        names.push_back(file);
        for (const auto& define : defines)
            if (std::ranges::find(all, define.first, &Defines::value_type::first) == all.end())
                all.push_back(define);
    }
    for (const auto& [file, defines] : files) {
        const KernelSource& source = kernel_source(file);
        if (build_options(device, source, defines) != build_options(device, source, all)) return;
    }
    build_together(device, names, all);
}

void Program::foresee(const Device& device, const ForeseenProgram& program) {
    if (program.files.empty() || device.is_counting() || compiles_kernels_alone(device.info()))
        return;
    for (const char* file : program.files) {
        const KernelSource& source = kernel_source(file);
        const auto locked = device.lock();
        const std::string options = build_options(device, source, program.defines);
        if (device.find_program(program_key(source, options))()) return;
    }
    const KernelSource source = kernel_source(program.files);
    CompileJob job{
        label_of(program.files), source.text(), build_options(device, source, program.defines), {}};
    for (const ForeseenKernel& kernel : program.kernels)
        job.kernels.push_back({kernel.name, group_size(device, kernel.work)});
    build_ahead(device, std::move(job));
}

Program Program::from_text(const Device& device, const std::string& source,
                           const Defines& defines) {
    return Program(device, "a test's kernel", expand_includes(source), defines);
}

Program::Program(const Device& device, const std::string& label, const KernelSource& source,
                 const Defines& defines)
    : device_(device), label_(label) {
    const std::string options = build_options(device, source, defines);
    const std::string key = program_key(source, options);
    if (compiles_kernels_alone(device.info())) {
        parts_ = device.kernel_builds().parts_of(key, source.text(), options);
        return;
    }
    const auto locked = device.lock();
    cl::Program program = device.find_program(key);
    if (!program()) {
        program = build_program(device, label, {source.text(), options});
        device.keep_program(key, program);
    }
    program_ = std::make_shared<cl::Program>(std::move(program));
}

Kernel Program::kernel(const std::string& name) const {
    if (parts_) return kernel_of_parts(name);
    auto made = std::make_shared<Kernel::Made>();
    made->label = label_;
    made->program = *program_;
    Kernel kernel(device_, name, std::move(made));
    kernel.made();
    return kernel;
}

Kernel Program::kernel_of_parts(const std::string& name) const {
    const auto found = parts_->kernels.find(name);
    if (found == parts_->kernels.end())
        throw Error(ErrorKind::build, "{} has no kernel {}", label_, name);
    const KernelPart& part = found->second;
    auto made = std::make_shared<Kernel::Made>();
    made->label = label_;
    made->key = part.key;
    {
        const auto locked = device_.lock();
        made->program = device_.find_program(part.key);
    }
    if (!made->program())
        made->build =
            device_.kernel_builds().start(compiler_target(device_), label_, part, parts_->whole);
    return {device_, name, std::move(made)};
}

}  // namespace voxelume
