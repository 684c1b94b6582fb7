// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/program_cache.hpp"

#include <CL/opencl.hpp>

#include <array>
#include <chrono>
#include <memory>
#include <optional>
#include <set>
#include <utility>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/opencl/ahead/kernel_compilers.hpp"
#include "runtime/opencl/build_log.hpp"
#include "runtime/opencl/device_call.hpp"
#include "runtime/opencl/kernel_builds.hpp"
#include "runtime/opencl/kernel_launcher.hpp"
#include "runtime/opencl/quirks/driver_quirks.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"
#include "runtime/opencl/source/compile_turn.hpp"
#include "runtime/opencl/source/kernel_slice.hpp"
#include "runtime/opencl/source/kernel_source.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxCacheBytes = 256u << 20;
constexpr const char* kCacheVersion = "voxelume programs 4";

DiskCache program_store() {
    return DiskCache(programs_folder(), kMaxCacheBytes, cache_bases("programs"));
}

/// The declarations of the functions of OpenCL C that kernels use, for PoCL.
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

/// A program's kernels, each with the key of its content.
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

cl::Program compile(const CompilerTarget& target, const std::string& label,
                    const ProgramText& text) {
    const DeviceCall call(target.info, "compiling ", label);
    const auto& [source, options] = text;
    cl::Program program(*target.context, source);
    const cl_device_id id = (*target.device)();
    cl_int status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    // If the compiler has no message about the source, it failed for another reason, which may be
    // over: a full disk, or other processes in the cache folder that the user gave to PoCL.
    if (status != CL_SUCCESS && log_of(program, *target.device).find("error") == std::string::npos)
        status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    if (status == CL_SUCCESS) return program;
    const std::string log = log_of(program, *target.device);
    if (log.empty() && status != CL_BUILD_PROGRAM_FAILURE)
        throw cl::Error(status, "clBuildProgram");
    const std::string errors = first_errors(log);
    throw Error(ErrorKind::build, "{}{}{}", status_name(status), errors.empty() ? "" : ": ",
                errors);
}

/// Compiles with a driver that is slow to declare the functions of OpenCL C. The macro _OPENCL_H_
/// makes it skip its own declarations, and it gets those that kernels use. If that doesn't compile,
/// because of the source or the driver's version, it reads its own declarations after all.
cl::Program compile_declared(const CompilerTarget& target, const std::string& label,
                             const ProgramText& text) {
    if (!driver_quirks(target.info.platform).is_slow_to_declare)
        return compile(target, label, text);
    try {
        return compile(target, label,
                       {declarations() + text.source, text.options + " -D_OPENCL_H_"});
    } catch (const Error&) {
        return compile(target, label, text);
    }
}

/// The program from the bytes that its driver gave us in an earlier run; empty if the driver now
/// rejects them.
std::optional<cl::Program> from_binary(const CompilerTarget& target, const std::string& label,
                                       const std::string& bytes, const std::string& options) {
    try {
        const DeviceCall call(target.info, "compiling ", label);
        const cl::Program::Binaries binaries = {{bytes.begin(), bytes.end()}};
        cl::Program program(*target.context, {*target.device}, binaries);
        program.build(*target.device, options.c_str());
        return program;
    } catch (const cl::Error&) {
        return std::nullopt;
    }
}

/// Compiles the first kernels of a program while a helper compiles the last ones. A failure costs
/// time only: what is missing is compiled when it is launched.
void compile_beside_helper(const CompilerTarget& target, const std::string& label,
                           const cl::Program& program, const std::string& key) {
    KernelCompilers& helpers = KernelCompilers::instance();
    const DeviceCall call(target.info, "compiling ", label);
    try {
        std::optional<KernelLauncher> launcher;
        while (const auto kernel = helpers.take(key)) {
            if (!launcher) launcher.emplace(*target.context, *target.device);
            launcher->compile(program, *kernel);
        }
    } catch (const cl::Error&) {
        return;
    }
}

/// Builds with PoCL, which keeps its own files.
BuiltProgram build_in_pocl_folder(const CompilerTarget& target, const std::string& label,
                                  const ProgramText& text) {
    BuiltProgram built;
    KernelCompilers& helpers = KernelCompilers::instance();
    const std::string key = key_of(target.info, "program", text);
    const bool is_shared = helpers.has_kernels_to_share(key);
    const bool was_compiled_ahead = !is_shared && helpers.await(key);
    const bool is_ready = PoclFolder::instance().build_with_files(
        program_store(), key, [&] { return parts_of(target.info, text); },
        [&] {
            built.program =
                std::make_shared<const cl::Program>(compile_declared(target, label, text));
            if (!is_shared) return false;
            compile_beside_helper(target, label, *built.program, key);
            helpers.await(key);
            return true;
        });
    built.is_from_cache = is_ready && !was_compiled_ahead && !is_shared;
    return built;
}

BuiltProgram build_or_read(const CompilerTarget& target, const std::string& label,
                           const ProgramText& text) {
    switch (driver_quirks(target.info.platform).keeping) {
        case ProgramKeeping::pocl_folder:
            return build_in_pocl_folder(target, label, text);
        case ProgramKeeping::none:
            return {std::make_shared<const cl::Program>(compile_declared(target, label, text))};
        case ProgramKeeping::binaries:
            break;
    }
    return build_with_binary(target, label, text);
}

BuiltProgram build(const CompilerTarget& target, const std::string& label,
                   const ProgramText& text) {
    const auto start = std::chrono::steady_clock::now();
    BuiltProgram built = build_or_read(target, label, text);
    const std::chrono::duration<double, std::milli> passed =
        std::chrono::steady_clock::now() - start;
    built.ms = passed.count();
    return built;
}

}  // namespace

bool keeps_pocl_folder(const DeviceInfo& info) {
    return driver_quirks(info.platform).keeping == ProgramKeeping::pocl_folder;
}

bool is_compiled_ahead(const DeviceInfo& info) {
    return keeps_pocl_folder(info) && !cache_folder().empty() &&
           KernelCompilers::instance().is_allowed() && !PoclFolder::instance().path().empty();
}

bool prepare_to_compile(const DeviceInfo& info) {
    return is_compiled_ahead(info) && program_store().refusal().empty() &&
           KernelCompilers::instance().start({info.index, info.name},
                                             PoclFolder::instance().path());
}

bool is_program_kept(const DeviceInfo& info, const ProgramText& text) {
    return program_store().read(key_of(info, "program", text)).has_value();
}

void build_ahead(const Device& device, CompileJob job) {
    const DeviceInfo& info = device.info();
    const std::string key = key_of(info, "program", {job.source, job.options});
    if (program_store().read(key)) {
        device.kernel_builds().begin(key, [target = compiler_target(device), job = std::move(job)] {
            return build(target, job.label, {job.source, job.options});
        });
    } else if (prepare_to_compile(info)) {
        KernelCompilers::instance().add({std::move(job), key});
    }
}

bool compiles_kernels_alone(const DeviceInfo& info) {
    return info.kind == DeviceKind::gpu && driver_quirks(info.platform).compiles_side_by_side;
}

std::string without_constants(std::string_view options) {
    std::string others;
    for (const std::string_view option : separate_options(options))
        if (!option.starts_with("-D")) others.append(option).append(" ");
    return others;
}

CompilerTarget compiler_target(const Device& device) {
    return {device.info(), std::make_shared<const cl::Context>(device.context()),
            std::make_shared<const cl::Device>(device.handle())};
}

BuiltProgram build_with_binary(const CompilerTarget& target, const std::string& label,
                               const ProgramText& text) {
    const DiskCache store = program_store();
    const std::string key = key_of(target.info, "program", text);
    CompileTurn turn;
    if (const auto bytes = turn.read(store, key))
        if (auto program = from_binary(target, label, *bytes, text.options))
            return {std::make_shared<const cl::Program>(std::move(*program)), true};
    BuiltProgram built{std::make_shared<const cl::Program>(compile(target, label, text))};
    try {
        // The binary is read right after the build.
        const auto binaries = built.program->getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.size() == 1 && !binaries[0].empty())
            store.write(key, std::string(binaries[0].begin(), binaries[0].end()));
    } catch (const cl::Error&) {
        return built;  // the driver doesn't give binaries
    }
    return built;
}

cl::Program build_program(const Device& device, const std::string& label, const ProgramText& text) {
    DeviceCounters& counters = device.counters();
    BuiltProgram built;
    try {
        auto begun = device.kernel_builds().take(key_of(device.info(), "program", text));
        counters.programs_begun += uint64_t(begun.has_value());
        built = begun ? std::move(*begun) : build(compiler_target(device), label, text);
    } catch (const Error& error) {
        fail_build(label, device.info(), error.what());
    } catch (const cl::Error& error) {
        throw_device_error(error, device.info(), "compiling " + label);
    }
    ++counters.programs_built;
    if (built.is_from_cache)
        ++counters.programs_from_cache;
    else
        device.note_fresh(*built.program);
    counters.build_ms += built.ms;
    return *built.program;
}

std::vector<std::string> program_sources(const Device& device) {
    std::set<cl_program> seen;
    std::vector<std::string> sources;
    for (const auto& [key, program] : device.programs())
        if (seen.insert(program()).second) sources.push_back(program.getInfo<CL_PROGRAM_SOURCE>());
    return sources;
}

void keep_compiled_kernels(const DeviceInfo& info) {
    if (keeps_pocl_folder(info)) PoclFolder::instance().publish(program_store());
}

void share_compiled_kernels(const Device& device) {
    if (!keeps_pocl_folder(device.info()) || !PoclFolder::instance().has_turn()) return;
    device.finish();
    PoclFolder::instance().share(program_store());
}

}  // namespace voxelume
