// SPDX-License-Identifier: Apache-2.0
// The program voxelume-kernel-compiler: compiles PoCL's kernels for kernel_compilers.cpp into the
// cache, in parallel to the process that will launch them.
//
// It asks for the kernels of a program one by one, and an exception ends it: the process that
// started it compiles what is missing.
#include <sys/prctl.h>
#include <unistd.h>

#include <CL/opencl.hpp>

#include <csignal>
#include <cstdlib>
#include <cstring>
#include <exception>
#include <stdexcept>

#include "runtime/base/helper/helper_process.hpp"
#include "runtime/opencl/ahead/compile_job.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/opencl/kernel_launcher.hpp"
#include "runtime/opencl/program_cache.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"

namespace voxelume {
namespace {

/// Throws std::runtime_error if nobody reads the answer.
void answer(HelperAnswer what) {
    const char byte = char(what);
    if (write(kHelperAnswer, &byte, 1) != 1) throw std::runtime_error("nobody reads answers");
}

/// Compiles the kernels of a job, one after another, as this program is told. Returns true if the
/// cache has the program afterwards: a disk may be full.
bool compile(const Device& device, const CompileJob& job, const KernelLauncher& launcher) {
    const ProgramText text = {job.source, job.options};
    const cl::Program program = build_program(device, job.label, text);
    keep_compiled_kernels(device.info());  // the process may make its program of this one
    for (;;) {
        answer(HelperAnswer::wants_kernel);
        const auto kernel = next_kernel(kHelperInput);
        if (!kernel) break;
        launcher.compile(program, *kernel);
    }
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
    const KernelLauncher launcher(device.context(), device.handle());
    while (const auto job = next_job(kHelperInput))
        answer(compile(device, *job, launcher) ? HelperAnswer::has_kept : HelperAnswer::has_failed);
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
