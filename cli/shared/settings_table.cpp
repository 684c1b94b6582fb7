// SPDX-License-Identifier: Apache-2.0
// The settings that there are, with the values that they can have.
#include <algorithm>
#include <array>
#include <limits>

#include "cli/shared/checks.hpp"
#include "cli/shared/settings.hpp"

namespace voxelume::cli {
namespace {

/// What is wrong with a value that must be one of the words.
template <size_t count>
std::string fault_of_word(const std::string& value,
                          const std::array<std::string_view, count>& words) {
    if (std::ranges::find(words, value) != words.end()) return {};
    return fmt::format("there is no {}{}", quote(value), suggest(value, words));
}

std::string fault_of_count(const std::string& value) {
    return in_range(1, std::numeric_limits<int>::max(), Number::whole)(value);
}

std::string fault_of_compilers(const std::string& value) {
    return in_range(0, kMaxKernelCompilers, Number::whole)(value);
}

std::string fault_of_cache_size(const std::string& value) {
    return in_range(0, 1 << 30, Number::whole)(value);
}

std::string fault_of_lanes(const std::string& value) {
    const bool is_known = one_of({"1", "4", "8", "16"})(value).empty();
    return is_known ? "" : "a work-item carries 1, 4, 8 or 16 rays";
}

std::string fault_of_progress(const std::string& value) {
    return fault_of_word(value,
                         std::array<std::string_view, 5>{"auto", "bar", "plain", "json", "none"});
}

std::string fault_of_self_test(const std::string& value) {
    return fault_of_word(value, std::array<std::string_view, 2>{"again", "off"});
}

constexpr std::array kSettings = {
    Setting{"assets", "VOXELUME_ASSETS", "folders of models, separated by colons", "none"},
    Setting{"cache_dir", "VOXELUME_CACHE_DIR",
            "folder of the cache, after colons behind folders that are only read; empty: keep "
            "nothing",
            "~/.cache/voxelume"},
    Setting{"cache_mb", "VOXELUME_CACHE_MB", "size of the cache of models and worlds", "4096",
            fault_of_cache_size},
    Setting{"compilers", "VOXELUME_COMPILERS",
            "processes that compile a first picture's kernels beside its own; 0: none",
            "1 if a core is idle", fault_of_compilers},
    Setting{"device", "VOXELUME_DEVICE", "what --device is without that option", "auto"},
    Setting{"lanes", "VOXELUME_LANES", "rays that a work-item carries: 1, 4, 8 or 16",
            "the device's own", fault_of_lanes},
    Setting{"memory_mb", "VOXELUME_MEMORY_MB", "maximum device memory that is used",
            "all that it offers", fault_of_count},
    Setting{"buffer_mb", "VOXELUME_BUFFER_MB", "maximum size of a buffer", "what the device allows",
            fault_of_count},
    Setting{"progress", "VOXELUME_PROGRESS", "what --progress is without that option", "auto",
            fault_of_progress},
    Setting{"self_test", "VOXELUME_SELF_TEST",
            "again: test the driver once more; off: use a device that failed", "once a driver",
            fault_of_self_test},
    Setting{"units", "VOXELUME_UNITS", "the number of compute units to use", "all", fault_of_count},
    Setting{"work_group", "VOXELUME_WORK_GROUP", "work-items of every work-group",
            "what suits the kernel", fault_of_count},
    Setting{"batch", "VOXELUME_BATCH", "rays that pass through the stages together",
            "what suits the device", fault_of_count},
    Setting{"build_options", "VOXELUME_BUILD_OPTIONS", "more options of the kernels' compiler",
            "none"},
};

constexpr std::array kShared = {
    SharedVariable{"HOME", "folder of the settings' file and of the cache"},
    SharedVariable{"XDG_CONFIG_HOME", "folder in whose voxelume/ the settings' file is"},
    SharedVariable{"XDG_CACHE_HOME", "folder in whose voxelume/ the cache is"},
    SharedVariable{"POCL_CACHE_DIR", "folder of PoCL's own cache, then kept"},
    SharedVariable{"POCL_MAX_PTHREAD_COUNT", "threads of PoCL; stress repeats it in its commands"},
    SharedVariable{"OCL_ICD_VENDORS", "where drivers are; then `check` always loads them"},
    SharedVariable{"OCL_ICD_FILENAMES", "drivers besides; then `check` always loads them"},
    SharedVariable{"OPENCL_VENDOR_PATH", "where drivers are; then `check` always loads them"},
    SharedVariable{"LD_LIBRARY_PATH", "folders of libraries; then `check` always loads drivers"},
    SharedVariable{"TERM", "dumb, or nothing: no bars of progress"},
    SharedVariable{"CI", "no bars of progress if it is set"},
    SharedVariable{"NO_COLOR", "bars of progress have no colour if it is set"},
};

}  // namespace

std::span<const Setting> settings() {
    return kSettings;
}

std::span<const SharedVariable> shared_variables() {
    return kShared;
}

}  // namespace voxelume::cli
