// SPDX-License-Identifier: Apache-2.0
// voxelume doctor: prints what a report of a fault needs.
#include <fmt/format.h>
#include <sys/utsname.h>
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <filesystem>
#include <memory>
#include <sstream>
#include <thread>

#include "cli/devices/doctor_tests.hpp"
#include "cli/shared/build_facts.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/report.hpp"
#include "cli/shared/warnings.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

struct DoctorCommand {
    std::string device;
    bool json = false, no_test = false;
};

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

/// The environment variables that affect Voxelume or its OpenCL.
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

/// The text form calls the column "cache base", because its table has no heading but the columns'.
Report cache_report(bool as_json) {
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

Report device_row(const DeviceInfo& info) {
    return {{"index", info.index},
            {"kind", name_of(info.kind)},
            {"name", info.name},
            {"platform", fmt::format("{} ({})", info.platform, info.platform_version)},
            {"driver", info.driver},
            {"memory", bytes_text(double(info.memory_bytes))},
            {"units", info.compute_units},
            {"lanes", info.lanes},
            {"known bits", name_of(info.self_test)},
            {"state", info.is_usable() ? "usable" : info.unusable_because}};
}

int run(const DoctorCommand& command) {
    Report report = system_report();
    report.update(cache_report(command.json));
    report["environment"] = environment_report();
    report["devices"] = Report::array();
    bool is_right = true;
    std::string fault;
    if (!command.no_test) {
        try {
            const Interruptible interruptible;
            const Device device = Device::open(command.device);
            report["tested"] = device.info().name;
            const DeviceTests tests = test_all_kernels(device, command.json, interruptible.stop());
            report.update(tests.report);
            is_right = tests.are_right;
        } catch (const Error& error) {
            if (error.kind() == ErrorKind::cancelled) throw;
            report["tested"] = fault = error.what();
        }
    }
    for (const DeviceInfo& info : list_devices()) report["devices"].push_back(device_row(info));
    print_report(report, command.json);
    if (!fault.empty()) throw Error(ErrorKind::device, "no self-test: " + fault);
    return is_right ? 0 : 1;
}

}  // namespace

Action add_doctor(CLI::App& app) {
    const auto command = std::make_shared<DoctorCommand>();
    app.add_option("--device", command->device,
                   "device to test: auto, cpu, gpu, a number, or part of a name")
        ->type_name("DEVICE")
        ->check(one_device);
    app.add_flag("--no-test", command->no_test, "leave the self-test out, which takes seconds");
    app.add_flag("--json", command->json, "print the report as JSON");
    return [command] { return run(*command); };
}

}  // namespace voxelume::cli
