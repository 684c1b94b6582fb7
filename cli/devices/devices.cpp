// SPDX-License-Identifier: Apache-2.0
// voxelume devices: lists what can render here, and says why other devices can't.
#include <fmt/format.h>
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "cli/shared/commands.hpp"
#include "runtime/voxelume.hpp"

namespace voxelume::cli {
namespace {

std::string gigabytes(uint64_t bytes) {
    return fmt::format("{:.1f} GB", double(bytes) / 1e9);
}

void print_json(const std::vector<DeviceInfo>& devices, int chosen) {
    nlohmann::ordered_json list = nlohmann::ordered_json::array();
    for (const DeviceInfo& info : devices)
        list.push_back({{"index", info.index},
                        {"kind", name_of(info.kind)},
                        {"name", info.name},
                        {"vendor", info.vendor},
                        {"platform", info.platform},
                        {"platform_version", info.platform_version},
                        {"version", info.version},
                        {"driver", info.driver},
                        {"memory_bytes", info.memory_bytes},
                        {"max_allocation_bytes", info.max_allocation_bytes},
                        {"compute_units", info.compute_units},
                        {"lanes", info.lanes},
                        {"self_test", name_of(info.self_test)},
                        {"usable", info.is_usable()},
                        {"chosen", info.index == chosen},
                        {"unusable_because", info.unusable_because},
                        {"note", info.note}});
    const auto keep = nlohmann::ordered_json::error_handler_t::replace;  // names in any encoding
    fmt::print("{}\n", list.dump(2, ' ', false, keep));
}

/// The device that renders without --device, or the reason why there is none.
struct Choice {
    int index = -1;
    std::string fault;
};

void print_table(const std::vector<DeviceInfo>& devices, const Choice& choice) {
    using Row = std::vector<std::string>;
    std::vector<Row> rows = {{"", "index", "kind", "name", "platform", "memory", "one buffer",
                              "units", "lanes", "self-test", "driver"}};
    for (const DeviceInfo& info : devices)
        rows.push_back({info.index == choice.index ? "*" : "", std::to_string(info.index),
                        name_of(info.kind), info.name, info.platform, gigabytes(info.memory_bytes),
                        gigabytes(info.max_allocation_bytes), std::to_string(info.compute_units),
                        std::to_string(info.lanes), name_of(info.self_test), info.driver});
    std::vector<size_t> widths(rows[0].size(), 0);
    for (const Row& row : rows)
        for (size_t i = 0; i < row.size(); ++i) widths[i] = std::max(widths[i], row[i].size());
    for (size_t number = 0; number < rows.size(); ++number) {
        std::string line;
        for (size_t i = 0; i < widths.size(); ++i)
            line += fmt::format("{:<{}}  ", rows[number][i], std::max<size_t>(widths[i], 1));
        line.erase(line.find_last_not_of(' ') + 1);
        fmt::print("{}\n", line);
        if (number == 0) continue;
        const DeviceInfo& info = devices[number - 1];
        if (!info.is_usable()) fmt::print("   not usable: {}\n", info.unusable_because);
        if (!info.note.empty()) fmt::print("   {}\n", info.note);
    }
    if (choice.index < 0)
        fmt::print("\n{}\n", choice.fault);
    else
        fmt::print(
            "\n* renders unless --device or VOXELUME_DEVICE names another by auto, cpu, "
            "gpu, index or part of a name.\n"
            "`render --device all` shares frames and tiles among all GPUs and a CPU, all/2 among "
            "two halves of a CPU, too.\n");
}

/// The chosen device. There is none if VOXELUME_DEVICE names a device that doesn't exist.
Choice choice_of_device() {
    try {
        return {Device::open().info().index, {}};
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::device || list_devices().empty()) throw;
        return {-1, error.what()};
    }
}

}  // namespace

Action add_devices(CLI::App& app) {
    auto json = std::make_shared<bool>(false);
    app.add_flag("--json", *json, "print everything known of each device, as a JSON array");
    return [json]() -> int {
        const Choice choice = choice_of_device();
        const std::vector<DeviceInfo> devices = list_devices();  // with their self-tests' results
        if (*json)
            print_json(devices, choice.index);
        else
            print_table(devices, choice);
        return 0;
    };
}

}  // namespace voxelume::cli
