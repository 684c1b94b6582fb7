// SPDX-License-Identifier: Apache-2.0
// What the library may do to its process, and what it keeps on disk.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace voxelume::v1 {

/// The version of the library: "0.2.0".
const char* version();

/// The permissions of the library in its process. Without any, the library sets no environment
/// variable, starts no process, installs no signal handler and prints nothing. (OpenCL drivers are
/// not the library: PoCL sets HWLOC_PLUGINS_PATH when it starts up.)
struct ProcessOptions {
    /// Sets POCL_CACHE_DIR while OpenCL starts up, and unsets it again: kernels that PoCL, the
    /// OpenCL of CPUs, compiled are then kept in Voxelume's own cache, where processes can't damage
    /// each other's. This isn't thread-safe against code of the program that reads the environment
    /// at that time. Without it PoCL keeps kernels where its own rules say, in ~/.cache/pocl.
    bool set_driver_environment = false;

    /// Lets the program voxelume-vdb-reader, which is installed with the library, read OpenVDB
    /// files: damaged ones make OpenVDB corrupt the memory of the process that reads them. The
    /// program is started by posix_spawn, once for each file. So are voxelume-image-decoder, which
    /// decodes OpenEXR, PNG and JPEG files, and voxelume-mesh-decoder, which decodes meshes of glTF
    /// files that Draco or meshoptimizer has compressed. Without this the process reads and decodes
    /// all but such meshes itself; these are refused. The limits of `limit_memory` don't count what
    /// the programs take.
    bool isolate_readers = false;

    /// The maximum number of processes voxelume-kernel-compiler that run in parallel to this
    /// process while it renders a first picture; 0: none. Each compiles kernels for PoCL into
    /// Voxelume's cache, since PoCL compiles on one core in a process. An image has one program, so
    /// one is enough for it. They are started by posix_spawn, once in a process, when a kernel is
    /// to be compiled, if `set_driver_environment` is set and the cache can be written. Each takes
    /// 250 MB of memory, and a thread of this process that waits for it; the limits of
    /// `limit_memory` don't count them.
    int kernel_compilers = 0;

    /// Threads that compress and expand OpenEXR files; 0: none but the caller's.
    int image_threads = 0;
};

/// Sets the options for the whole process; to be called before any other function of the library,
/// once.
void configure(const ProcessOptions& options);

/// The cores that the process may use, by its affinity and its control groups (containers, jobs of
/// farms), less the threads of the whole machine that are running now, one of which belongs to this
/// process: 0 or less on a busy machine. It helps to choose `kernel_compilers`. Any thread may call
/// it, before `configure`, too.
int idle_cores();

/// Deletes files that the process has begun to write and not finished: the hidden files next to
/// outputs and the folder of its kernels. It is for a program that has to end while calls of the
/// library still run; these calls fail if they continue. It also ends the processes that compile
/// kernels, for good. Any thread may call it.
void remove_unfinished_files();

/// Calls `late` once, from a thread of its own, when a call of an OpenCL driver has lasted more
/// than `seconds`, with a sentence that names the device and its task. A call that hangs can't be
/// ended: a program can only report it and end. Some drivers compile kernels during calls, which
/// takes seconds.
void watch_devices(double seconds, std::function<void(const std::string& sentence)> late);

/// Limits later plans and renders to `bytes` of main memory, and to as many of a device's own:
/// those that need more throw Error::limit before memory is taken. 0: as much as the machine, the
/// process's control group and its resource limits allow, as without this call. Devices that are
/// open already keep their limit. Any thread may call it.
void limit_memory(uint64_t bytes);

/// The user's folder for compiled kernels, models and worlds: the last one of VOXELUME_CACHE_DIR,
/// or else XDG_CACHE_HOME/voxelume, or else ~/.cache/voxelume. Empty if nothing is kept.
std::filesystem::path user_cache_folder();

/// The folders before the last one of VOXELUME_CACHE_DIR, between colons. Nothing is written to
/// them; what the user's folder lacks is read from them, if they are the user's or root's and
/// nobody else may write there.
std::vector<std::filesystem::path> user_cache_bases();

/// The reason why nothing is read from such a folder, or from a folder in it: "it belongs to
/// another user". Empty if it is read.
std::string cache_base_refusal(const std::filesystem::path& base);

/// The options of the cache of voxelized models and worlds on disk, which finds them by the bytes
/// of their sources.
struct CacheOptions {
    bool enabled = true;  ///< false: neither read nor written
    /// Empty: `models` in the user's folder of Voxelume, which is VOXELUME_CACHE_DIR or else
    /// ~/.cache/voxelume. Kernels are always kept in the user's folder.
    std::filesystem::path folder{};
    /// Maximum size in megabytes; without it VOXELUME_CACHE_MB, or else 4096.
    std::optional<uint64_t> max_megabytes{};
};

}  // namespace voxelume::v1
