// SPDX-License-Identifier: Apache-2.0
// voxelume doctor: prints what a report of a fault needs.
#include <fmt/format.h>

#include <CLI/CLI.hpp>
#include <memory>
#include <string>

#include "cli/devices/doctor_system.hpp"
#include "cli/devices/doctor_tests.hpp"
#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/interrupt.hpp"
#include "cli/shared/report.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

struct DoctorCommand {
    std::string device;
    bool json = false, no_test = false;
};

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
