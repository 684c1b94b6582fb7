// SPDX-License-Identifier: Apache-2.0
// Results of self-tests, kept so that a driver is tested once.
#include <array>
#include <cstdlib>
#include <map>
#include <mutex>
#include <string_view>

#include "runtime/base/error.hpp"
#include "runtime/base/files/disk_cache.hpp"
#include "runtime/opencl/self_test/known_answers.hpp"
#include "runtime/opencl/self_test/self_test.hpp"
#include "runtime/opencl/source/kernel_source.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxResultBytes = 1u << 20;
constexpr const char* kResultVersion = "voxelume self-tests 1";

DiskCache fault_store() {
    const std::filesystem::path folder = cache_folder();
    return DiskCache(folder.empty() ? folder : folder / "drivers", kMaxResultBytes,
                     cache_bases("drivers"));
}

/// The results of this process, in case nothing can be kept.
struct Results {
    std::mutex mutex;
    std::map<std::string, std::string> faults;  ///< by key
};

Results& results() {
    static Results all;
    return all;
}

/// All questions of the self-test, and their answers.
std::string known_words() {
    std::string bytes;
    for (const std::span<const KnownRow> rows : {known_questions(), known_answers()})
        for (const KnownRow& row : rows)
            bytes.append(reinterpret_cast<const char*>(row.words.data()), sizeof row.words);
    for (const std::array<uint8_t, 3>& voxel : known_voxels())
        bytes.append(voxel.begin(), voxel.end());
    return bytes;
}

/// The cache's key of a device's result. A hash of the questions is part of it.
std::string result_key(const DeviceInfo& info) {
    const std::string lanes = std::to_string(info.lanes), group = std::to_string(info.work_group);
    const std::string known = known_words();
    const std::array<std::string_view, 10> parts = {kResultVersion,
                                                    known,
                                                    kernel_source("self_test.cl").text(),
                                                    info.platform,
                                                    info.platform_version,
                                                    info.name,
                                                    info.driver,
                                                    lanes,
                                                    group,
                                                    info.build_options};
    return cache_key(parts);
}

}  // namespace

SelfTestMode self_test_mode() {
    const char* const value = std::getenv("VOXELUME_SELF_TEST");
    const std::string_view text = value ? value : "";
    if (text.empty()) return SelfTestMode::once;
    if (text == "again") return SelfTestMode::again;
    if (text == "off") return SelfTestMode::off;
    throw Error(ErrorKind::usage, "VOXELUME_SELF_TEST={}: must be again or off", text);
}

std::optional<std::string> fresh_fault(const DeviceInfo& info) {
    const std::string key = result_key(info);
    const std::lock_guard lock(results().mutex);
    const auto found = results().faults.find(key);
    if (found == results().faults.end()) return std::nullopt;
    return found->second;
}

std::optional<std::string> kept_fault(const DeviceInfo& info) {
    if (std::optional<std::string> fault = fresh_fault(info)) return fault;
    const std::string key = result_key(info);
    const std::lock_guard lock(results().mutex);
    std::optional<std::string> fault = fault_store().read(key);
    if (fault) results().faults[key] = *fault;
    return fault;
}

void keep_fault(const DeviceInfo& info, const std::string& fault) {
    const std::string key = result_key(info);
    const std::lock_guard lock(results().mutex);
    results().faults[key] = fault;
    fault_store().write(key, fault);
}

}  // namespace voxelume
