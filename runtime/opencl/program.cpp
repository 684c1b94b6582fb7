#include "runtime/opencl/program.hpp"

#include <CL/opencl.hpp>

#include <algorithm>
#include <array>

#include "runtime/base/disk_cache.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

/// Only the constants that the source mentions, so that scenes which differ in others share what
/// was compiled.
std::string build_options(const Device& device, const KernelSource& source, Defines defines) {
    std::string options = "-cl-std=CL1.2";
    if (std::ranges::find(defines, "VXL_LANES", &Defines::value_type::first) == defines.end())
        defines.emplace_back("VXL_LANES", device.lanes());
    for (const auto& [name, value] : defines)
        if (source.mentions(name)) options += fmt::format(" -D{}={}", name, value);
    // Oclgrind 21.10 interprets LLVM code, but not the alias hints that its optimizer leaves.
    if (device.info().platform == "Oclgrind") options += " -cl-opt-disable";
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

}  // namespace

void Kernel::set_buffer(uint32_t index, const BufferStorage* buffer) {
    const cl_mem memory = buffer ? buffer->handle()() : nullptr;
    set_bytes(index, sizeof(cl_mem), &memory);
}

void Kernel::set_bytes(uint32_t index, size_t bytes, const void* value) {
    const cl_int status = clSetKernelArg((*kernel_)(), index, bytes, value);
    if (status != CL_SUCCESS)
        throw Error(ErrorKind::render, "kernel {}: argument {} of {} bytes refused with {}", name_,
                    index, bytes, status_name(status));
}

void Kernel::enqueue(WorkItem work, size_t count) {
    if (count == 0) return;
    // A fixed local size per kernel and two dimensions below 65535: PoCL builds a kernel again for
    // every other local size, and for any larger dimension.
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
    std::vector<cl::Program*> places;
    std::vector<const char*> missing;
    std::vector<ProgramText> parts;
    const auto locked = device.lock();
    for (const char* file : files) {
        const KernelSource& source = kernel_source(file);
        const std::string options = build_options(device, source, defines);
        cl::Program& place = device.programs()[program_key(source, options)];
        if (place()) continue;
        places.push_back(&place);
        missing.push_back(file);
        parts.push_back({source.text(), options});
    }
    if (missing.empty()) return;
    const KernelSource source = kernel_source(missing);
    const cl::Program program =
        build_program(device, fmt::format("kernels/{}", fmt::join(missing, " with kernels/")),
                      {source.text(), build_options(device, source, defines)}, parts);
    for (cl::Program* place : places) *place = program;
}

Program Program::from_text(const Device& device, const std::string& source,
                           const Defines& defines) {
    return Program(device, "a test's kernel", expand_includes(source), defines);
}

Program::Program(const Device& device, const std::string& label, const KernelSource& source,
                 const Defines& defines)
    : device_(device), label_(label) {
    const std::string options = build_options(device, source, defines);
    const auto locked = device.lock();
    cl::Program& kept = device.programs()[program_key(source, options)];
    if (!kept()) kept = build_program(device, label, {source.text(), options});
    program_ = std::make_shared<cl::Program>(kept);
}

Kernel Program::kernel(const std::string& name) const {
    try {
        return Kernel(device_, std::make_shared<cl::Kernel>(*program_, name.c_str()), name);
    } catch (const cl::Error& error) {
        throw Error(ErrorKind::build, "{} has no kernel {} on \"{}\" ({})", label_, name,
                    device_.info().name, status_name(error.err()));
    }
}

}  // namespace voxelume
