// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/border/process.hpp"

#include <algorithm>
#include <chrono>
#include <mutex>
#include <thread>

#include "runtime/api/border/guarded.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/base/files/temporary_files.hpp"
#include "runtime/base/idle_cores.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/base/version.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/mesh_codec/mesh_codec.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/opencl/ahead/kernel_compilers.hpp"
#include "runtime/opencl/device_call.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"

namespace voxelume {
namespace {

std::mutex options_mutex;
bool are_applied = false;

void apply(const v1::ProcessOptions& options) {
    PoclFolder::allow(options.set_driver_environment);
    isolate_vdb_readers(options.isolate_readers);
    allow_mesh_decoder(options.isolate_readers);
    decode_images({.is_apart = options.isolate_readers});
    KernelCompilers::instance().allow(options.set_driver_environment ? options.kernel_compilers
                                                                     : 0);
    if (options.image_threads > 0) set_exr_threads(options.image_threads);
    are_applied = true;
}

}  // namespace

void api::apply_process_options() {
    const std::lock_guard lock(options_mutex);
    if (!are_applied) apply({});
}

ModelCache api::model_cache(const v1::CacheOptions& options) {
    if (!options.enabled) return {};
    if (options.folder.empty() && !options.max_megabytes) return ModelCache::of_user();
    return ModelCache::of_user(options.folder, options.max_megabytes);
}

namespace v1 {

const char* version() {
    return voxelume::version();
}

void configure(const ProcessOptions& options) {
    api::guarded([&] {
        const std::lock_guard lock(options_mutex);
        apply(options);
    });
}

int idle_cores() {
    return api::guarded([] { return count_idle_cores(); });
}

void limit_memory(uint64_t bytes) {
    limit_main_memory(bytes);
}

void watch_devices(double seconds, std::function<void(const std::string& sentence)> late) {
    const std::chrono::duration<double> limit(seconds);
    std::thread([limit, late = std::move(late)] {
        for (;;) {
            std::this_thread::sleep_for(std::min(limit / 4, std::chrono::duration<double>(0.25)));
            if (const auto sentence = late_call(limit)) return late(*sentence);
        }
    }).detach();
}

std::filesystem::path user_cache_folder() {
    return api::guarded([] { return cache_folder(); });
}

std::vector<std::filesystem::path> user_cache_bases() {
    return api::guarded([] { return cache_bases(); });
}

std::string cache_base_refusal(const std::filesystem::path& base) {
    return api::guarded([&] { return refusal_of_base(base); });
}

void remove_unfinished_files() {
    delete_temporary_files();
    KernelCompilers::instance().end();
    PoclFolder::remove();
}

}  // namespace v1
}  // namespace voxelume
