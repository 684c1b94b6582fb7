// SPDX-License-Identifier: Apache-2.0
#include "cli/devices/doctor_system.hpp"

#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <algorithm>
#include <filesystem>
#include <sstream>
#include <string>
#include <string_view>
#include <thread>

#include "cli/shared/build_facts.hpp"
#include "cli/shared/warnings.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {

Report system_report() {
    utsname system{};
    uname(&system);
    const double pages = double(sysconf(_SC_PHYS_PAGES)) * double(sysconf(_SC_PAGESIZE));
    Report report = {{"version", version()}};
    std::istringstream facts(build_facts());
    for (std::string line; std::getline(facts, line);)
        if (const size_t colon = line.find(": "); colon != std::string::npos)
            report[line.substr(0, colon)] = line.substr(colon + 2);
    report.update(
        {{"system", fmt::format("{} {} {}", system.sysname, system.release, system.machine)},
         {"processors", std::thread::hardware_concurrency()},
         {"main memory", bytes_text(pages)}});
    return report;
}

Report environment_report() {
    Report report = Report::object();
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry;
        for (const std::string_view prefix : {"VOXELUME_", "POCL_", "OCL_", "OPENCL_"})
            if (text.starts_with(prefix)) {
                const size_t end = std::min(text.find('='), text.size() - 1);
                report[std::string(text.substr(0, end))] = std::string(text.substr(end + 1));
            }
    }
    return report;
}

Report cache_report(bool as_json) {
    namespace fs = std::filesystem;
    const fs::path folder = user_cache_folder();
    Report report;
    report["cache"] = folder.empty() ? "none: nothing is kept" : folder.string();
    for (const fs::path& base : user_cache_bases()) {
        const std::string refusal = cache_base_refusal(base);
        report["cache bases"].push_back(
            {{as_json ? "folder" : "cache base", base.string()},
             {"state", refusal.empty() ? "is read" : "isn't read: " + refusal}});
    }
    if (folder.empty()) return report;
    std::error_code error;
    uintmax_t bytes = 0, files = 0;
    for (fs::recursive_directory_iterator entry(folder, error);
         !error && entry != fs::recursive_directory_iterator(); entry.increment(error)) {
        std::error_code ignored;
        if (!entry->is_regular_file(ignored)) continue;
        ++files;
        bytes += entry->file_size(ignored);
    }
    const bool is_there = fs::is_directory(folder, error);
    const bool can_write = access(folder.c_str(), R_OK | W_OK) == 0;
    report["cache state"] = !is_there   ? "not made yet"
                            : can_write ? "can be written"
                                        : "can't be written";
    report["cache files"] = files;
    report["cache size"] = bytes_text(double(bytes));
    return report;
}

}  // namespace voxelume::cli
