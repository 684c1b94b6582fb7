// SPDX-License-Identifier: Apache-2.0
// voxelume config: the values of all settings, and where each comes from.
#include <CLI/CLI.hpp>
#include <algorithm>
#include <memory>

#include "cli/checks.hpp"
#include "cli/commands.hpp"
#include "cli/report.hpp"
#include "cli/settings.hpp"

namespace voxelume::cli {
namespace {

int print_settings(bool as_json) {
    Report rows = Report::array();
    for (const SettingValue& value : loaded_settings()) {
        const Setting& setting = *value.setting;
        const bool is_default = value.origin == "default";
        if (as_json)
            rows.push_back({{"name", setting.name},
                            {"variable", setting.variable},
                            {"value", is_default ? Report(nullptr) : Report(value.value)},
                            {"origin", value.origin}});
        else
            rows.push_back({{"setting", setting.name},
                            {"value", is_default ? setting.default_text : quote(value.value)},
                            {"origin", value.origin}});
    }
    if (as_json) {
        print_report({{"file", settings_file().string()}, {"settings", rows}}, true);
        return 0;
    }
    size_t width = 26;
    for (const Report& row : rows)
        width = std::max(width, row["value"].get_ref<const std::string&>().size());
    for (const Report& row : rows)
        fmt::print("  {:<12}{:<{}}  {}\n", row["setting"].get<std::string>(),
                   row["value"].get<std::string>(), width, row["origin"].get<std::string>());
    const std::filesystem::path file = settings_file();
    std::error_code error;
    if (!file.empty() && !std::filesystem::exists(file, error))
        fmt::print("\nNo file {}; lines such as `device = cpu` in it would be settings.\n",
                   file.string());
    return 0;
}

}  // namespace

Action add_config(CLI::App& app) {
    const auto json = std::make_shared<bool>(false);
    app.add_flag("--json", *json, "print the settings as JSON");
    return [json] { return print_settings(*json); };
}

}  // namespace voxelume::cli
