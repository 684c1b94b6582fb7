// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/kernel_launcher.hpp"

#include <vector>

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

}  // namespace

KernelLauncher::KernelLauncher(const cl::Context& context, const cl::Device& device)
    : queue_(context, device) {
    const std::vector<char> zeroes(kDummyBytes, 0);
    dummy_ = cl::Buffer(context, CL_MEM_READ_WRITE | CL_MEM_COPY_HOST_PTR, kDummyBytes,
                        const_cast<char*>(zeroes.data()));
}

void KernelLauncher::compile(const cl::Program& program, const CompiledKernel& wanted) const {
    const cl::Kernel kernel(program, wanted.name.c_str());
    const auto arguments = kernel.getInfo<CL_KERNEL_NUM_ARGS>();
    for (cl_uint i = 0; i < arguments; ++i)
        if (!set_zero(kernel, i, dummy_)) return;
    const cl::NDRange group(wanted.group, 1);
    queue_.enqueueNDRangeKernel(kernel, cl::NullRange, group, group);
    queue_.finish();
}

}  // namespace voxelume
