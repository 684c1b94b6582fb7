// SPDX-License-Identifier: Apache-2.0
// A library that is preloaded into the program or a test. It makes PoCL's CPU claim to be a GPU
// with its own memory, on another vendor's platform: kernels get a GPU's lanes, batches, arithmetic
// and compilation.
//
// With VXL_PROGRAMS=FOLDER, the source of each program is written to FOLDER/NUMBER.cl when it is
// built, and its options to FOLDER/NUMBER.opt.
#define CL_TARGET_OPENCL_VERSION 120
#include <CL/cl.h>
#include <dlfcn.h>

#include <atomic>
#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <string>

namespace {

constexpr char kPlatform[] = "Stand-in";

template <class Function>
Function next(const char* name) {
    return reinterpret_cast<Function>(dlsym(RTLD_NEXT, name));
}

std::string source_of(cl_program program) {
    size_t bytes = 0;
    clGetProgramInfo(program, CL_PROGRAM_SOURCE, 0, nullptr, &bytes);
    std::string source(bytes, '\0');
    clGetProgramInfo(program, CL_PROGRAM_SOURCE, bytes, source.data(), nullptr);
    return source.c_str();
}

void record(cl_program program, const char* options) {
    const char* const folder = std::getenv("VXL_PROGRAMS");
    if (!folder) return;
    const std::string source = source_of(program);
    if (source.empty()) return;  // made from a binary
    static std::atomic<int> programs{0};
    char number[16];
    std::snprintf(number, sizeof number, "/%04d", programs++);
    std::ofstream(folder + std::string(number) + ".cl") << source;
    std::ofstream(folder + std::string(number) + ".opt") << (options ? options : "");
}

}  // namespace

extern "C" {

cl_int clGetDeviceInfo(cl_device_id device, cl_device_info info, size_t size, void* value,
                       size_t* needed) {
    static const auto real = next<decltype(&clGetDeviceInfo)>("clGetDeviceInfo");
    const cl_int status = real(device, info, size, value, needed);
    if (value && info == CL_DEVICE_TYPE) {
        const cl_device_type type = CL_DEVICE_TYPE_GPU;
        std::memcpy(value, &type, sizeof type);
    }
    if (value && info == CL_DEVICE_HOST_UNIFIED_MEMORY) std::memset(value, 0, sizeof(cl_bool));
    return status;
}

cl_int clGetPlatformInfo(cl_platform_id platform, cl_platform_info info, size_t size, void* value,
                         size_t* needed) {
    static const auto real = next<decltype(&clGetPlatformInfo)>("clGetPlatformInfo");
    if (info != CL_PLATFORM_NAME) return real(platform, info, size, value, needed);
    if (value && size < sizeof kPlatform) return CL_INVALID_VALUE;
    if (value) std::memcpy(value, kPlatform, sizeof kPlatform);
    if (needed) *needed = sizeof kPlatform;
    return CL_SUCCESS;
}

cl_int clBuildProgram(cl_program program, cl_uint devices, const cl_device_id* list,
                      const char* options, void(CL_CALLBACK* notify)(cl_program, void*),
                      void* data) {
    static const auto real = next<decltype(&clBuildProgram)>("clBuildProgram");
    record(program, options);
    return real(program, devices, list, options, notify, data);
}

}  // extern "C"
