#include "runtime/opencl/program_cache.hpp"

#include <array>
#include <chrono>
#include <optional>
#include <utility>

#include "runtime/disk_cache.hpp"
#include "runtime/error.hpp"
#include "runtime/opencl/pocl_folder.hpp"
#include "runtime/opencl/status.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxCacheBytes = 256u << 20;
constexpr const char* kCacheVersion = "voxelume programs 1";

DiskCache program_store() {
    const std::filesystem::path folder = cache_folder();
    return DiskCache(folder.empty() ? folder : folder / "programs", kMaxCacheBytes);
}

std::string key_of(const DeviceInfo& info, const std::string& source, const std::string& options) {
    const std::array<std::string_view, 7> parts = {
        kCacheVersion, info.platform, info.platform_version, info.name, info.driver,
        options,       source};
    return cache_key(parts);
}

std::string log_of(const cl::Program& program, const cl::Device& device) {
    std::string log;
    if (program() && program.getBuildInfo(device, CL_PROGRAM_BUILD_LOG, &log) != CL_SUCCESS)
        return {};
    return log;
}

cl::Program compile(const Device& device, const std::string& source, const std::string& options) {
    cl::Program program(device.context(), source);
    const cl_device_id id = device.handle()();
    cl_int status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    // A compiler that has nothing to say about the source failed for another reason, which may
    // have passed: a full disk, other processes in the cache folder that the user gave to PoCL.
    if (status != CL_SUCCESS && log_of(program, device.handle()).find("error") == std::string::npos)
        status = clBuildProgram(program(), 1, &id, options.c_str(), nullptr, nullptr);
    if (status == CL_SUCCESS) return program;
    throw Error(ErrorKind::build, "{}:\n{}", status_name(status), log_of(program, device.handle()));
}

/// The program from the bytes that its driver gave us in an earlier run, unless it now refuses
/// them.
std::optional<cl::Program> from_binary(const Device& device, const std::string& bytes,
                                       const std::string& options) {
    try {
        const cl::Program::Binaries binaries = {{bytes.begin(), bytes.end()}};
        cl::Program program(device.context(), {device.handle()}, binaries);
        program.build(device.handle(), options.c_str());
        return program;
    } catch (const cl::Error&) {
        return std::nullopt;
    }
}

/// Ordinary drivers: the binary is asked for right after the build.
cl::Program build_with_binary(const Device& device, const std::string& source,
                              const std::string& options) {
    const DiskCache store = program_store();
    const std::string key = key_of(device.info(), source, options);
    if (const auto bytes = store.read(key))
        if (auto program = from_binary(device, *bytes, options)) {
            ++device.counters().programs_from_cache;
            return std::move(*program);
        }
    cl::Program program = compile(device, source, options);
    try {
        const auto binaries = program.getInfo<CL_PROGRAM_BINARIES>();
        if (binaries.size() == 1 && !binaries[0].empty())
            store.write(key, std::string(binaries[0].begin(), binaries[0].end()));
    } catch (const cl::Error&) {
        return program;  // a driver that keeps its binaries to itself
    }
    return program;
}

/// PoCL compiles twice when asked for a binary, and keeps its own files: see PoclFolder.
cl::Program build_with_pocl(const Device& device, const std::string& source,
                            const std::string& options) {
    cl::Program program;
    const bool ready = PoclFolder::instance().build_with_files(
        program_store(), key_of(device.info(), source, options),
        [&] { program = compile(device, source, options); });
    if (ready) ++device.counters().programs_from_cache;
    return program;
}

}  // namespace

cl::Program build_program(const Device& device, const std::string& label, const std::string& source,
                          const std::string& options) {
    const auto start = std::chrono::steady_clock::now();
    cl::Program program;
    try {
        if (device.info().platform == kPoclPlatform)
            program = build_with_pocl(device, source, options);
        else if (device.info().platform == "Oclgrind")  // interprets; a binary loses the lines
            program = compile(device, source, options);
        else
            program = build_with_binary(device, source, options);
    } catch (const Error& error) {
        throw Error(ErrorKind::build, "{} does not compile on \"{}\" with {}: {}", label,
                    device.info().name, options, error.what());
    } catch (const cl::Error& error) {
        throw_device_error(error, device.info(), "compiling " + label);
    }
    ++device.counters().programs_built;
    device.counters().build_ms +=
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count();
    return program;
}

void keep_compiled_kernels(const DeviceInfo& info) {
    if (info.platform == kPoclPlatform) PoclFolder::instance().publish(program_store());
}

}  // namespace voxelume
