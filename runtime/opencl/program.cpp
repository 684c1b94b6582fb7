// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/program.hpp"

#include <CL/opencl.hpp>

#include <algorithm>
#include <array>
#include <utility>

#include "runtime/base/disk_cache.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

/// The compiler's options, with only those constants that the source mentions. So scenes that
/// differ in other constants share compiled programs.
std::string build_options(const Device& device, const KernelSource& source, Defines defines) {
    // Without -w PoCL's compiler counts its warnings on stderr: on a CPU without AVX-512 there is
    // one for every function that takes sixteen numbers.
    std::string options = "-cl-std=CL1.2 -cl-kernel-arg-info -w";
    if (std::ranges::find(defines, "VXL_LANES", &Defines::value_type::first) == defines.end())
        defines.emplace_back("VXL_LANES", device.lanes());
    std::ranges::sort(defines);  // in any order, they make the same program
    for (const auto& [name, value] : defines)
        if (source.mentions(name)) options += fmt::format(" -D{}={}", name, value);
    // Oclgrind 21.10 interprets LLVM code, but not the alias hints that LLVM adds as it inlines.
    if (device.info().platform == "Oclgrind") options += " -cl-opt-disable -DOCLGRIND";
    if (!device.info().build_options.empty()) options += " " + device.info().build_options;
    return options;
}

std::string program_key(const KernelSource& source, const std::string& options) {
    const std::array<std::string_view, 2> parts = {source.text(), options};
    return cache_key(parts);
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

/// Structs and vectors are often another view of what the host has.
bool is_number(std::string_view element) {
    constexpr std::string_view kNumbers[] = {"char", "uchar", "short", "ushort", "int",
                                             "uint", "long",  "ulong", "float"};
    return std::ranges::find(kNumbers, element) != std::end(kNumbers);
}

}  // namespace

Kernel::Kernel(Device device, std::shared_ptr<cl::Kernel> kernel, std::string name)
    : device_(std::move(device)),
      kernel_(std::move(kernel)),
      name_(std::move(name)),
      parameters_(std::make_shared<std::vector<std::string>>(parameter_types(*kernel_))) {}

void Kernel::check_type(uint32_t index, bool is_buffer, std::string_view type) const {
    if (index >= parameters_->size()) check_count(index + 1);
    const std::string_view parameter = (*parameters_)[index];
    if (parameter.empty()) return;
    const std::string_view element = element_of(parameter);
    const bool fits = type.empty() || !is_number(element) || element == type;
    if (fits && is_buffer == parameter.ends_with('*')) return;
    throw Error(ErrorKind::render, "kernel {}: argument {} is {}{}, but the parameter is {}", name_,
                index, is_buffer ? "a buffer of " : "a value of type ",
                type.empty() ? "a struct or vector" : type, parameter);
}

void Kernel::check_count(uint32_t count) const {
    if (count == parameters_->size()) return;
    throw Error(ErrorKind::render, "kernel {} has {} parameters, but gets {}{} arguments", name_,
                parameters_->size(), count > parameters_->size() ? "at least " : "", count);
}

void Kernel::set_buffer(uint32_t index, const BufferStorage* buffer) {
    const cl_mem memory = buffer ? buffer->handle()() : nullptr;
    set_bytes(index, sizeof(cl_mem), &memory);
}

void Kernel::set_bytes(uint32_t index, size_t bytes, const void* value) {
    const cl_int status = clSetKernelArg((*kernel_)(), index, bytes, value);
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
    device_.enqueue(*kernel_, name_, cl::NDRange(columns, rows), cl::NDRange(local, 1));
}

Program::Program(const Device& device, const std::string& file, const Defines& defines)
    : Program(device, "kernels/" + file, kernel_source(file), defines) {}

void Program::build_together(const Device& device, std::span<const char* const> files,
                             const Defines& defines) {
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
    const cl::Program program =
        build_program(device, fmt::format("kernels/{}", fmt::join(missing, " with kernels/")),
                      {source.text(), build_options(device, source, defines)});
    for (const std::string& key : keys) device.keep_program(key, program);
}

void Program::build_together(const Device& device, std::span<const ProgramFile> files) {
    if (device.is_counting()) return;
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

Program Program::from_text(const Device& device, const std::string& source,
                           const Defines& defines) {
    return Program(device, "a test's kernel", expand_includes(source), defines);
}

Program::Program(const Device& device, const std::string& label, const KernelSource& source,
                 const Defines& defines)
    : device_(device), label_(label) {
    const std::string options = build_options(device, source, defines);
    const std::string key = program_key(source, options);
    const auto locked = device.lock();
    cl::Program program = device.find_program(key);
    if (!program()) {
        program = build_program(device, label, {source.text(), options});
        device.keep_program(key, program);
    }
    program_ = std::make_shared<cl::Program>(std::move(program));
}

Kernel Program::kernel(const std::string& name) const {
    try {
        Kernel kernel(device_, std::make_shared<cl::Kernel>(*program_, name.c_str()), name);
        device_.note_kernel(*program_, name);
        return kernel;
    } catch (const cl::Error& error) {
        if (error.err() == CL_INVALID_KERNEL_NAME)
            throw Error(ErrorKind::build, "{} has no kernel {} on \"{}\" ({})", label_, name,
                        device_.info().name, status_name(error.err()));
        throw_device_error(error, device_.info(), fmt::format("making {} of {}", name, label_));
    }
}

}  // namespace voxelume
