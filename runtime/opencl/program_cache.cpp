// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/program_cache.hpp"

#include <CL/opencl.hpp>

#include <array>
#include <chrono>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/base/disk_cache.hpp"
#include "runtime/base/error.hpp"
#include "runtime/opencl/compile_turn.hpp"
#include "runtime/opencl/device_call.hpp"
#include "runtime/opencl/kernel_slice.hpp"
#include "runtime/opencl/kernel_source.hpp"
#include "runtime/opencl/pocl_folder.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxCacheBytes = 256u << 20;
constexpr const char* kCacheVersion = "voxelume programs 3";

DiskCache program_store() {
    const std::filesystem::path folder = cache_folder();
    return DiskCache(folder.empty() ? folder : folder / "programs", kMaxCacheBytes,
                     cache_bases("programs"));
}

/// The functions of OpenCL C that kernels use, as PoCL is told of them.
const std::string& declarations() {
    static const std::string text = kernel_source("lib/lanes/declared.h").text();
    return text;
}

/// The key of an entry of the cache. `what` says what is kept: a program, or compiled kernels.
std::string key_of(const DeviceInfo& info, std::string_view what, const ProgramText& text) {
    const std::array<std::string_view, 9> parts = {
        kCacheVersion,  what,         info.platform, info.platform_version, info.name, info.driver,
        declarations(), text.options, text.source};
    return cache_key(parts);
}

/// The options of a compiler without its -D constants.
std::string without_constants(std::string_view options) {
    std::string others;
    for (const std::string_view option : separate_options(options))
        if (!option.starts_with("-D")) others.append(option).append(" ");
    return others;
}

/// A program's kernels, each by the key of what it consists of.
std::vector<ProgramPart> parts_of(const DeviceInfo& info, const ProgramText& text) {
    const std::string options = without_constants(text.options);
    std::vector<ProgramPart> parts;
    for (KernelSlice& slice : slice_kernels(text.source, text.options))
        parts.push_back(
            {key_of(info, "kernel", {std::move(slice.text), options}), slice.kernel, 0});
    return parts;
}

/// The compiler's messages; empty where the driver has none.
std::string log_of(const cl::Program& program, const cl::Device& device) {
    try {
        return program.getBuildInfo<CL_PROGRAM_BUILD_LOG>(device);
    } catch (const cl::Error&) {
        return {};
    }
}

cl::Program compile(const Device& device, const std::string& label, const ProgramText& text) {
    const DeviceCall call(device.info(), "compiling ", label);
    const auto& [source, options] = text;
    cl::Program program(device.context(), source);
    const cl_device_id id = device.handle()();
    cl_int status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    // If the compiler has no message about the source, it failed for another reason, which may be
    // over: a full disk, or other processes in the cache folder that the user gave to PoCL.
    if (status != CL_SUCCESS && log_of(program, device.handle()).find("error") == std::string::npos)
        status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    if (status == CL_SUCCESS) return program;
    const std::string log = log_of(program, device.handle());
    if (log.empty() && status != CL_BUILD_PROGRAM_FAILURE)
        throw cl::Error(status, "clBuildProgram");
    throw Error(ErrorKind::build, "{}:\n{}", status_name(status), log);
}

/// Compiles with PoCL. It would read 17,000 declarations for each program, which takes 80 ms. So it
/// is told that it has read them (_OPENCL_H_), and given those that kernels use. Where that doesn't
/// compile, because of the source or the version of PoCL, it reads its own after all.
cl::Program compile_with_pocl(const Device& device, const std::string& label,
                              const ProgramText& text) {
    try {
        return compile(device, label,
                       {declarations() + text.source, text.options + " -D_OPENCL_H_"});
    } catch (const Error&) {
        return compile(device, label, text);
    }
}

/// The program from the bytes that its driver gave us in an earlier run; empty if the driver now
/// rejects them.
std::optional<cl::Program> from_binary(const Device& device, const std::string& label,
                                       const std::string& bytes, const std::string& options) {
    try {
        const DeviceCall call(device.info(), "compiling ", label);
        const cl::Program::Binaries binaries = {{bytes.begin(), bytes.end()}};
        cl::Program program(device.context(), {device.handle()}, binaries);
        program.build(device.handle(), options.c_str());
        return program;
    } catch (const cl::Error&) {
        return std::nullopt;
    }
}

/// Builds with an ordinary driver: its binary is read right after the build.
cl::Program build_with_binary(const Device& device, const std::string& label,
                              const ProgramText& text) {
    const DiskCache store = program_store();
    const std::string key = key_of(device.info(), "program", text);
    CompileTurn turn;
    if (const auto bytes = turn.read(store, key))
        if (auto program = from_binary(device, label, *bytes, text.options)) {
            ++device.counters().programs_from_cache;
            return std::move(*program);
        }
    cl::Program program = compile(device, label, text);
    try {
        const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.size() == 1 && !binaries[0].empty())
            store.write(key, std::string(binaries[0].begin(), binaries[0].end()));
    } catch (const cl::Error&) {
        return program;  // a driver that doesn't give its binaries
    }
    return program;
}

/// Builds with PoCL, which compiles twice if asked for a binary, and keeps its own files: see
/// PoclFolder.
cl::Program build_with_pocl(const Device& device, const std::string& label,
                            const ProgramText& text) {
    cl::Program program;
    const bool ready = PoclFolder::instance().build_with_files(
        program_store(), key_of(device.info(), "program", text),
        [&] { return parts_of(device.info(), text); },
        [&] { program = compile_with_pocl(device, label, text); });
    if (ready) ++device.counters().programs_from_cache;
    return program;
}

}  // namespace

cl::Program build_program(const Device& device, const std::string& label, const ProgramText& text) {
    const auto start = std::chrono::steady_clock::now();
    const uint64_t from_cache = device.counters().programs_from_cache;
    cl::Program program;
    try {
        if (device.info().platform == kPoclPlatform)
            program = build_with_pocl(device, label, text);
        else if (device.info().platform == "Oclgrind")  // it interprets code; a binary would lose
                                                        // the line numbers
            program = compile(device, label, text);
        else
            program = build_with_binary(device, label, text);
    } catch (const Error& error) {
        throw Error(ErrorKind::build, "{} does not compile on \"{}\" with {}: {}", label,
                    device.info().name, text.options, error.what());
    } catch (const cl::Error& error) {
        throw_device_error(error, device.info(), "compiling " + label);
    }
    ++device.counters().programs_built;
    if (device.counters().programs_from_cache == from_cache) device.note_fresh(program);
    device.counters().build_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return program;
}

std::vector<std::string> program_sources(const Device& device) {
    std::set<cl_program> seen;
    std::vector<std::string> sources;
    for (const auto& [key, program] : device.programs())
        if (seen.insert(program()).second) sources.push_back(program.getInfo<CL_PROGRAM_SOURCE>());
    return sources;
}

void keep_compiled_kernels(const DeviceInfo& info) {
    if (info.platform == kPoclPlatform) PoclFolder::instance().publish(program_store());
}

void share_compiled_kernels(const Device& device) {
    if (device.info().platform != kPoclPlatform || !PoclFolder::instance().has_turn()) return;
    device.finish();
    PoclFolder::instance().share(program_store());
}

}  // namespace voxelume
