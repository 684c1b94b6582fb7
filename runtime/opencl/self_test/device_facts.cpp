// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/self_test/device_facts.hpp"

#include <dlfcn.h>
#include <fmt/format.h>
#include <sched.h>
#include <sys/resource.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cctype>
#include <charconv>
#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <map>
#include <mutex>
#include <optional>
#include <string>
#include <vector>

#include "runtime/base/files/disk_cache.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/opencl/device_settings.hpp"
#include "runtime/opencl/platforms.hpp"
#include "runtime/opencl/selector.hpp"
#include "runtime/opencl/self_test/self_test.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

constexpr uint64_t kMaxFactsBytes = 1u << 20;
constexpr uint64_t kMaxNameBytes = 1u << 16;  // of a file that names a driver
constexpr const char* kFactsVersion = "voxelume device facts 1";

DiskCache facts_store() {
    const fs::path folder = cache_folder();
    return DiskCache(folder.empty() ? folder : folder / "devices", kMaxFactsBytes);
}

/// The environment, in which any name may be a driver's, without what shells change all the time.
std::string environment_text() {
    std::vector<std::string_view> all;
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry, name = text.substr(0, text.find('='));
        if (name != "PWD" && name != "OLDPWD" && name != "SHLVL" && name != "_" &&
            name != "COLUMNS" && name != "LINES")
            all.push_back(text);
    }
    std::ranges::sort(all);
    return fmt::format("{}", fmt::join(all, "\n"));
}

/// What changes when a file is replaced; empty if there is none.
std::string state_of(const fs::path& file) {
    struct stat state {};
    if (stat(file.c_str(), &state) != 0) return {};
    return fmt::format("{} {} {} {}.{}\n", file.string(), state.st_ino, state.st_size,
                       state.st_mtim.tv_sec, state.st_mtim.tv_nsec);
}

std::string text_of(const fs::path& file) {
    std::ifstream stream(file, std::ios::binary);
    return {std::istreambuf_iterator<char>(stream), {}};
}

bool is_set(const char* variable) {
    const char* const value = std::getenv(variable);
    return value != nullptr && *value != '\0';
}

/// True if drivers or their libraries may be looked for in other places than the system's.
bool has_drivers_of_its_own() {
    return is_set("OCL_ICD_VENDORS") || is_set("OCL_ICD_FILENAMES") ||
           is_set("OPENCL_VENDOR_PATH") || is_set("LD_LIBRARY_PATH");
}

/// A library that a driver's file names, by a path or as one of the system's.
std::string library_text(const std::string& library) {
    if (library.find('/') != library.npos) return state_of(library);
    std::string text;
    for (const char* const folder :
         {"/lib", "/lib64", "/lib/x86_64-linux-gnu", "/usr/local/lib", "/lib/aarch64-linux-gnu"})
        text += state_of(fs::path(folder) / library);
    return text;
}

/// The files that name the system's drivers, with their contents and libraries, and the state of
/// all packages.
std::string drivers_text() {
    const fs::path vendors = "/etc/OpenCL/vendors";
    std::vector<fs::path> files;
    std::error_code error;
    for (const fs::directory_entry& entry : fs::directory_iterator(vendors, error)) {
        const bool names_a_driver = entry.path().extension() == ".icd" &&
                                    entry.is_regular_file(error) &&
                                    entry.file_size(error) <= kMaxNameBytes;
        if (names_a_driver) files.push_back(entry.path());
    }
    std::ranges::sort(files);
    std::string text = state_of(vendors) + state_of("/etc/ld.so.cache") +
                       state_of("/var/lib/dpkg/status") + state_of("/var/lib/rpm/rpmdb.sqlite");
    for (const fs::path& file : files) {
        std::string library = text_of(file);
        while (!library.empty() && std::isspace(static_cast<unsigned char>(library.back())) != 0)
            library.pop_back();
        text += state_of(file) + library + "\n" + library_text(library);
    }
    return text;
}

/// The cards that the kernel of the machine offers, and whether this process may use them.
std::string cards_text() {
    std::vector<std::string> names;
    std::error_code error;
    for (const char* const folder : {"/dev", "/dev/dri"})
        for (const fs::directory_entry& entry : fs::directory_iterator(folder, error)) {
            const std::string name = entry.path().filename().string();
            if (name.starts_with("nvidia") || name.starts_with("kfd") || name.starts_with("render"))
                names.push_back(name +
                                (access(entry.path().c_str(), R_OK | W_OK) == 0 ? "+" : "-"));
        }
    std::ranges::sort(names);
    return fmt::format("{}", fmt::join(names, "\n"));
}

/// The limits that drivers take for the size of memory.
std::string limits_text() {
    std::string text;
    for (const auto limit : {RLIMIT_DATA, RLIMIT_AS}) {
        struct rlimit value {};
        if (getrlimit(limit, &value) == 0) text += fmt::format("{} ", value.rlim_cur);
    }
    return text;
}

/// The processors that this process may use.
std::string processors_text() {
    cpu_set_t set;
    CPU_ZERO(&set);
    if (sched_getaffinity(0, sizeof set, &set) != 0) return {};
    std::string text;
    for (int i = 0; i < CPU_SETSIZE; ++i) text += CPU_ISSET(i, &set) ? '1' : '0';
    return text;
}

/// The file that this code is in: another version may choose and describe devices otherwise.
std::string program_text() {
    Dl_info self{};
    const bool is_found = dladdr(reinterpret_cast<const void*>(&device_for_plans), &self) != 0;
    return state_of("/proc/self/exe") +
           (is_found && self.dli_fname != nullptr ? state_of(self.dli_fname) : std::string());
}

std::string facts_key(const std::string& selector) {
    const std::string environment = environment_text(), drivers = drivers_text();
    const std::string cards = cards_text(), processors = processors_text();
    const std::string limits = limits_text(), program = program_text();
    const std::string boot = text_of("/proc/sys/kernel/random/boot_id");
    const std::string_view parts[] = {kFactsVersion, program,    selector, environment, drivers,
                                      cards,         processors, limits,   boot};
    return cache_key(parts);
}

/// The facts as lines of text; empty if one of them has several lines. `unusable` isn't among them,
/// since only devices that were opened are kept.
std::string to_text(const DeviceInfo& info) {
    const std::string text =
        fmt::format("{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n{}\n", info.index,
                    int(info.kind), info.name, info.vendor, info.platform, info.platform_version,
                    info.version, info.driver, info.memory, info.max_allocation, info.compute_units,
                    info.clock, int(info.shares_memory), info.card, info.lanes, info.note);
    return std::ranges::count(text, '\n') == 16 ? text : std::string();
}

/// Reads lines one after the other.
class Lines {
  public:
    explicit Lines(std::string_view text) : left_(text) {}

    std::string text() {
        const size_t end = left_.find('\n');
        if (end == left_.npos) {
            is_whole_ = false;
            return {};
        }
        std::string line(left_.substr(0, end));
        left_.remove_prefix(end + 1);
        return line;
    }
    template <class Number>
    Number number() {
        const std::string line = text();
        Number value = 0;
        const auto [stop, error] = std::from_chars(line.data(), line.data() + line.size(), value);
        is_whole_ &= error == std::errc() && stop == line.data() + line.size();
        return value;
    }
    bool is_whole() const { return is_whole_ && left_.empty(); }

  private:
    std::string_view left_;
    bool is_whole_ = true;
};

std::optional<DeviceInfo> from_text(std::string_view text) {
    Lines lines(text);
    DeviceInfo info;
    info.index = lines.number<int>();
    const int kind = lines.number<int>();
    info.kind = kind == int(DeviceKind::cpu)   ? DeviceKind::cpu
                : kind == int(DeviceKind::gpu) ? DeviceKind::gpu
                                               : DeviceKind::other;
    for (std::string* const field : {&info.name, &info.vendor, &info.platform,
                                     &info.platform_version, &info.version, &info.driver})
        *field = lines.text();
    info.memory = lines.number<uint64_t>();
    info.max_allocation = lines.number<uint64_t>();
    info.compute_units = lines.number<int>();
    info.clock = lines.number<int>();
    info.shares_memory = lines.number<int>() != 0;
    info.card = lines.text();
    info.lanes = lines.number<int>();
    info.note = lines.text();
    if (!lines.is_whole()) return std::nullopt;
    return info;
}

/// The kept facts with this process's settings, if the driver's self-test is known to have passed.
std::optional<DeviceInfo> kept_facts(const DiskCache& store, const std::string& key) {
    if (self_test_mode() == SelfTestMode::again) return std::nullopt;
    const std::optional<std::string> text = store.read(key);
    if (!text) return std::nullopt;
    std::optional<DeviceInfo> info = from_text(*text);
    if (!info) return std::nullopt;
    *info = settled(*info, 0);
    if (self_test_mode() == SelfTestMode::off) return info;
    if (kept_fault(*info) != std::string()) return std::nullopt;
    info->self_test = SelfTest::passed;
    return info;
}

void keep_facts(const DiskCache& store, const std::string& key, const DeviceInfo& info) {
    const std::string text = to_text(info);
    if (!text.empty()) store.write(key, text);
}

/// The facts of the device that a selector names, kept or found.
DeviceInfo facts_of(const std::string& selector, const std::string& key) {
    if (parts_of_all(selector) > 0) return Device::open_all(selector).front().info();
    if (has_drivers_of_its_own()) return Device::open(selector).info();
    const DiskCache store = facts_store();
    if (std::optional<DeviceInfo> info = kept_facts(store, key)) return *info;
    DeviceInfo opened = Device::open(selector).info();
    for (const Candidate& candidate : find_candidates())
        if (candidate.info.index == opened.index) keep_facts(store, key, candidate.info);
    return opened;
}

}  // namespace

DeviceInfo device_for_plans(std::string_view selector) {
    static std::mutex mutex;
    static std::map<std::string, DeviceInfo> found;
    const std::string wanted = selector_or_default(selector), key = facts_key(wanted);
    const std::string here = fmt::format("{} {} {}", key, main_memory(), chosen_memory_limit());
    const std::lock_guard lock(mutex);
    const auto known = found.find(here);
    if (known != found.end()) return known->second;
    return found[here] = facts_of(wanted, key);
}

}  // namespace voxelume
