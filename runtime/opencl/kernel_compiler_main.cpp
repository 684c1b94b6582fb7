// SPDX-License-Identifier: Apache-2.0
// The program voxelume-kernel-compiler: compiles PoCL's kernels for kernel_compilers.cpp into the
// cache, in parallel to the process that will launch them.
//
// PoCL compiles a kernel at its first launch. So each is launched once, for one group, with zeroes:
// kernels return at once where their work-item's number isn't below the count that they are given.
#include <sys/prctl.h>
#include <unistd.h>

#include <CL/opencl.hpp>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <vector>

#include "runtime/base/helper/helper_process.hpp"
#include "runtime/opencl/ahead/compile_job.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"

namespace voxelume {
namespace {

/// A size above the bytes that a kernel may touch before it has looked at its count.
constexpr size_t kDummyBytes = 1 << 20;
/// More than any structure that kernels take by value.
constexpr size_t kMaxValueBytes = 4096;

/// Sets an argument to zeroes: a buffer, or a value of the size that the driver accepts.
bool set_zero(const cl::Kernel& kernel, cl_uint index, const cl::Buffer& dummy) {
    const auto where = kernel.getArgInfo<CL_KERNEL_ARG_ADDRESS_QUALIFIER>(index);
    if (where == CL_KERNEL_ARG_ADDRESS_GLOBAL || where == CL_KERNEL_ARG_ADDRESS_CONSTANT) {
        const cl_mem memory = dummy();
        return clSetKernelArg(kernel(), index, sizeof(cl_mem), &memory) == CL_SUCCESS;
    }
    if (where == CL_KERNEL_ARG_ADDRESS_LOCAL)
        return clSetKernelArg(kernel(), index, kMaxValueBytes, nullptr) == CL_SUCCESS;
    alignas(128) static const char zeroes[kMaxValueBytes] = {};
    // PoCL 3.1 takes any size, and reads what the kernel's parameter has.
    for (size_t bytes = kMaxValueBytes; bytes > 0; --bytes)
        if (clSetKernelArg(kernel(), index, bytes, zeroes) == CL_SUCCESS) return true;
    return false;
}

void launch(const Device& device, const cl::Program& program, const CompiledKernel& wanted,
            const cl::Buffer& dummy) {
    const cl::Kernel kernel(program, wanted.name.c_str());
    const auto arguments = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    for (cl_uint i = 0; i < arguments; ++i)
        if (!set_zero(kernel, i, dummy)) return;
    const cl::NDRange group(wanted.group, 1);
    device.queue().enqueueNDRangeKernel(kernel, cl::NullRange, group, group);
}

/// Returns true if the cache has the program afterwards: a disk may be full.
bool compile(const Device& device, const CompileJob& job, const cl::Buffer& dummy) {
    const ProgramText text = {job.source, job.options};
    const cl::Program program = build_program(device, job.label, text);
    for (const CompiledKernel& kernel : job.kernels) launch(device, program, kernel, dummy);
    device.finish();
    keep_compiled_kernels(device.info());
    return is_program_kept(device.info(), text);
}

/// Arguments: the version, the folder for PoCL's files, the device's number and its name, and the
/// number of the process that started this one.
int serve(int count, char** arguments) {
    if (count != 6 || std::strcmp(arguments[1], VXL_VERSION) != 0) return 2;
    if (prctl(PR_SET_PDEATHSIG, SIGKILL) != 0 || getppid() != std::atoi(arguments[5])) return 3;
    setenv("VOXELUME_SELF_TEST", "off", 1);
    setenv("POCL_MAX_PTHREAD_COUNT", "1", 1);  // nothing runs here that more threads would speed up
    PoclFolder::place_in(arguments[2]);
    const Device device = Device::open(arguments[3]);
    if (device.info().name != arguments[4] || !keeps_pocl_folder(device.info())) return 4;
    if (PoclFolder::instance().path().empty()) return 4;  // its files would be among the user's
    // PoCL reads its library of functions, which takes 0.3 s, when it first builds.
    cl::Program(device.context(), "kernel void nothing() {}").build(device.handle());
    const std::vector<char> zeroes(kDummyBytes, 0);
    const cl::Buffer dummy(device.context(), CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, kDummyBytes,
                           const_cast<char*>(zeroes.data()));
    while (const auto job = next_job(kHelperInput)) {
        char is_done = 0;
        try {
            is_done = char(compile(device, *job, dummy));
        } catch (const std::exception&) {
            is_done = 0;
        }
        if (write(kHelperAnswer, &is_done, 1) != 1) return 0;
    }
    return 0;
}

}  // namespace
}  // namespace voxelume

int main(int count, char** arguments) {
    try {
        return voxelume::serve(count, arguments);
    } catch (const std::exception&) {
        return 5;
    }
}
