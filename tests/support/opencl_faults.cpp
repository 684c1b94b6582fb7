// SPDX-License-Identifier: Apache-2.0
// A library that is preloaded into the program. It stands between the program and OpenCL, counts
// calls, and makes one of them fail, wait or never return.
//
// VXL_FAULT=NAME:N:CODE makes the N-th call of the function NAME (from 1 on) do nothing and return
// the status CODE; with `hang` as the code, it never returns, and with `delay` it waits for half a
// second first. VXL_FAULT=clEnqueueReadBuffer:N:wrong makes the N-th read return a wrong first bit.
// VXL_FAULT=clCreateBuffer:BYTES:large makes every buffer of more than BYTES fail for want of
// memory. VXL_FAULT_COUNTS=FILE writes the number of calls of each function to FILE when a program
// that made calls ends, VXL_FAULT_SITES=FILE the numbers of the first calls from each site (a site
// is a stack of calls), and VXL_FAULT_LEFT=FILE the numbers of objects that the program made and
// didn't release; in the counts, `large` is the number of buffers that were too large.
#define CL_TARGET_OPENCL_VERSION 120
#define CL_USE_DEPRECATED_OPENCL_1_1_APIS
#include <CL/cl.h>
#include <dlfcn.h>
#include <execinfo.h>
#include <unistd.h>

#include <cstdio>
#include <cstdlib>
#include <cstring>
#include <map>
#include <mutex>
#include <optional>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace {

constexpr cl_int kWrong = 1;  // not a status, because those of failures are negative

struct Fault {
    std::string name;
    long number = 0;
    cl_int code = 0;
    bool hangs = false, delays = false, is_large = false;
};

/// The fault that VXL_FAULT asks for. An unknown form ends the program.
Fault requested_fault() {
    Fault fault;
    const char* const text = std::getenv("VXL_FAULT");
    if (!text) return fault;
    char name[64], code[16];
    if (std::sscanf(text, "%63[^:]:%ld:%15s", name, &fault.number, code) != 3) std::abort();
    fault.name = name;
    fault.hangs = std::strcmp(code, "hang") == 0;
    fault.delays = std::strcmp(code, "delay") == 0;
    fault.is_large = std::strcmp(code, "large") == 0;
    fault.code = std::strcmp(code, "wrong") == 0 ? kWrong : std::atoi(code);
    return fault;
}

class Calls {
  public:
    ~Calls() {
        // There are no counts in `timeout`, which ends after the program that it starts.
        if (counts_.empty()) return;
        write(std::getenv("VXL_FAULT_COUNTS"), counts_);
        write(std::getenv("VXL_FAULT_LEFT"), left_);
        write(sites_file_, sites_);
    }

    /// Adds to the number of references to objects of a kind.
    void add_left(const char* kind, long references) {
        const std::lock_guard lock(mutex_);
        left_[kind] += references;
    }

    bool is_too_large(size_t bytes) {
        if (!fault_.is_large || bytes <= size_t(fault_.number)) return false;
        const std::lock_guard lock(mutex_);
        ++counts_["large"];
        return true;
    }

    /// Counts a call. Returns the status with which it should fail, if any.
    std::optional<cl_int> count(const char* name) {
        bool is_it = false;
        {
            const std::lock_guard lock(mutex_);
            is_it = ++counts_[name] == fault_.number && fault_.name == name && !fault_.is_large;
            if (sites_file_ && is_new_place(name)) sites_.emplace_back(name, counts_[name]);
        }
        if (!is_it) return std::nullopt;
        while (fault_.hangs) pause();
        if (!fault_.delays) return fault_.code;
        usleep(500'000);
        return std::nullopt;
    }

  private:
    /// Writes lines of a function's name and a number.
    template <class Rows>
    static void write(const char* file, const Rows& rows) {
        FILE* const out = file ? std::fopen(file, "w") : nullptr;
        if (!out) return;
        for (const auto& [name, number] : rows) std::fprintf(out, "%s %ld\n", name.c_str(), number);
        std::fclose(out);
    }

    bool is_new_place(const char* name) {
        std::vector<void*> stack(64);
        stack.resize(size_t(backtrace(stack.data(), int(stack.size()))));
        return places_[name].insert(std::move(stack)).second;
    }

    std::mutex mutex_;
    std::map<std::string, long> counts_, left_;
    std::vector<std::pair<std::string, long>> sites_;
    std::map<std::string, std::set<std::vector<void*>>> places_;
    const char* const sites_file_ = std::getenv("VXL_FAULT_SITES");
    const Fault fault_ = requested_fault();
};

Calls calls;

template <class Function>
Function* next(const char* name) {
    return reinterpret_cast<Function*>(dlsym(RTLD_NEXT, name));
}

}  // namespace

// Defines a function that returns its status.
#define VXL_STATUS_CALL(name, parameters, arguments)                     \
    extern "C" cl_int name parameters {                                  \
        static decltype(&name) const real = next<decltype(name)>(#name); \
        const std::optional<cl_int> status = calls.count(#name);         \
        return status ? *status : real arguments;                        \
    }

// Defines a function that returns an object, and its status through its last parameter, `error`.
#define VXL_OBJECT_CALL(type, name, parameters, arguments)               \
    extern "C" type name parameters {                                    \
        static decltype(&name) const real = next<decltype(name)>(#name); \
        const std::optional<cl_int> status = calls.count(#name);         \
        type const object = status ? nullptr : real arguments;           \
        if (status && error) *error = *status;                           \
        calls.add_left(#type, object != nullptr);                        \
        return object;                                                   \
    }

// Define the functions that change the number of references to objects of a type.
#define VXL_REFERENCES(type, what)                                                    \
    extern "C" cl_int clRetain##what(type object) {                                   \
        static auto* const real = next<decltype(clRetain##what)>("clRetain" #what);   \
        calls.add_left(#type, 1);                                                     \
        return real(object);                                                          \
    }                                                                                 \
    extern "C" cl_int clRelease##what(type object) {                                  \
        static auto* const real = next<decltype(clRelease##what)>("clRelease" #what); \
        calls.add_left(#type, -1);                                                    \
        return real(object);                                                          \
    }
VXL_REFERENCES(cl_context, Context)
VXL_REFERENCES(cl_command_queue, CommandQueue)
VXL_REFERENCES(cl_mem, MemObject)
VXL_REFERENCES(cl_program, Program)
VXL_REFERENCES(cl_kernel, Kernel)

#define VXL_WAITS cl_uint waits, const cl_event *events, cl_event *event
#define VXL_TRANSFER \
    cl_command_queue queue, cl_mem buffer, cl_bool blocks, size_t offset, size_t size

VXL_STATUS_CALL(clGetPlatformIDs, (cl_uint count, cl_platform_id* ids, cl_uint* found),
                (count, ids, found))
VXL_STATUS_CALL(clGetPlatformInfo,
                (cl_platform_id id, cl_platform_info what, size_t size, void* value, size_t* found),
                (id, what, size, value, found))
VXL_STATUS_CALL(clGetDeviceIDs,
                (cl_platform_id platform, cl_device_type type, cl_uint count, cl_device_id* ids,
                 cl_uint* found),
                (platform, type, count, ids, found))
VXL_STATUS_CALL(clGetDeviceInfo,
                (cl_device_id id, cl_device_info what, size_t size, void* value, size_t* found),
                (id, what, size, value, found))
VXL_STATUS_CALL(clCreateSubDevices,
                (cl_device_id id, const cl_device_partition_property* properties, cl_uint count,
                 cl_device_id* ids, cl_uint* found),
                (id, properties, count, ids, found))
VXL_OBJECT_CALL(cl_context, clCreateContext,
                (const cl_context_properties* properties, cl_uint count, const cl_device_id* ids,
                 void(CL_CALLBACK* notify)(const char*, const void*, size_t, void*), void* data,
                 cl_int* error),
                (properties, count, ids, notify, data, error))
VXL_OBJECT_CALL(cl_command_queue, clCreateCommandQueue,
                (cl_context context, cl_device_id id, cl_command_queue_properties properties,
                 cl_int* error),
                (context, id, properties, error))
extern "C" cl_mem clCreateBuffer(cl_context context, cl_mem_flags flags, size_t size, void* memory,
                                 cl_int* error) {
    static auto* const real = next<decltype(clCreateBuffer)>("clCreateBuffer");
    std::optional<cl_int> status = calls.count("clCreateBuffer");
    if (calls.is_too_large(size)) status = CL_MEM_OBJECT_ALLOCATION_FAILURE;
    const cl_mem object = status ? nullptr : real(context, flags, size, memory, error);
    if (status && error) *error = *status;
    calls.add_left("cl_mem", object != nullptr);
    return object;
}
VXL_OBJECT_CALL(cl_program, clCreateProgramWithSource,
                (cl_context context, cl_uint count, const char** texts, const size_t* sizes,
                 cl_int* error),
                (context, count, texts, sizes, error))
VXL_OBJECT_CALL(cl_program, clCreateProgramWithBinary,
                (cl_context context, cl_uint count, const cl_device_id* ids, const size_t* sizes,
                 const unsigned char** binaries, cl_int* statuses, cl_int* error),
                (context, count, ids, sizes, binaries, statuses, error))
VXL_STATUS_CALL(clBuildProgram,
                (cl_program program, cl_uint count, const cl_device_id* ids, const char* options,
                 void(CL_CALLBACK* notify)(cl_program, void*), void* data),
                (program, count, ids, options, notify, data))
VXL_STATUS_CALL(clGetProgramInfo,
                (cl_program program, cl_program_info what, size_t size, void* value, size_t* found),
                (program, what, size, value, found))
VXL_STATUS_CALL(clGetProgramBuildInfo,
                (cl_program program, cl_device_id id, cl_program_build_info what, size_t size,
                 void* value, size_t* found),
                (program, id, what, size, value, found))
VXL_OBJECT_CALL(cl_kernel, clCreateKernel, (cl_program program, const char* name, cl_int* error),
                (program, name, error))
VXL_STATUS_CALL(clGetKernelInfo,
                (cl_kernel kernel, cl_kernel_info what, size_t size, void* value, size_t* found),
                (kernel, what, size, value, found))
VXL_STATUS_CALL(clGetKernelArgInfo,
                (cl_kernel kernel, cl_uint argument, cl_kernel_arg_info what, size_t size,
                 void* value, size_t* found),
                (kernel, argument, what, size, value, found))
VXL_STATUS_CALL(clSetKernelArg,
                (cl_kernel kernel, cl_uint argument, size_t size, const void* value),
                (kernel, argument, size, value))
VXL_STATUS_CALL(clEnqueueNDRangeKernel,
                (cl_command_queue queue, cl_kernel kernel, cl_uint dimensions, const size_t* offset,
                 const size_t* items, const size_t* group, VXL_WAITS),
                (queue, kernel, dimensions, offset, items, group, waits, events, event))
extern "C" cl_int clEnqueueReadBuffer(VXL_TRANSFER, void* to, VXL_WAITS) {
    static auto* const real = next<decltype(clEnqueueReadBuffer)>("clEnqueueReadBuffer");
    const std::optional<cl_int> fault = calls.count("clEnqueueReadBuffer");
    const bool is_wrong = fault && *fault == kWrong;
    if (fault && !is_wrong) return *fault;
    const cl_int status =
        real(queue, buffer, is_wrong ? CL_TRUE : blocks, offset, size, to, waits, events, event);
    if (is_wrong) *static_cast<char*>(to) ^= 1;
    return status;
}
VXL_STATUS_CALL(clEnqueueWriteBuffer, (VXL_TRANSFER, const void* from, VXL_WAITS),
                (queue, buffer, blocks, offset, size, from, waits, events, event))
VXL_STATUS_CALL(clEnqueueCopyBuffer,
                (cl_command_queue queue, cl_mem from, cl_mem to, size_t from_offset,
                 size_t to_offset, size_t size, VXL_WAITS),
                (queue, from, to, from_offset, to_offset, size, waits, events, event))
VXL_STATUS_CALL(clEnqueueFillBuffer,
                (cl_command_queue queue, cl_mem buffer, const void* pattern, size_t pattern_size,
                 size_t offset, size_t size, VXL_WAITS),
                (queue, buffer, pattern, pattern_size, offset, size, waits, events, event))
extern "C" void* clEnqueueMapBuffer(cl_command_queue queue, cl_mem buffer, cl_bool blocks,
                                    cl_map_flags flags, size_t offset, size_t size, VXL_WAITS,
                                    cl_int* error) {
    static auto* const real = next<decltype(clEnqueueMapBuffer)>("clEnqueueMapBuffer");
    const std::optional<cl_int> status = calls.count("clEnqueueMapBuffer");
    if (!status)
        return real(queue, buffer, blocks, flags, offset, size, waits, events, event, error);
    if (error) *error = *status;
    return nullptr;
}
VXL_STATUS_CALL(clEnqueueUnmapMemObject,
                (cl_command_queue queue, cl_mem buffer, void* memory, VXL_WAITS),
                (queue, buffer, memory, waits, events, event))
VXL_STATUS_CALL(clFinish, (cl_command_queue queue), (queue))
VXL_STATUS_CALL(clSetMemObjectDestructorCallback,
                (cl_mem buffer, void(CL_CALLBACK* notify)(cl_mem, void*), void* data),
                (buffer, notify, data))
