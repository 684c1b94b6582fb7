// SPDX-License-Identifier: Apache-2.0
// voxelume config: the values of all settings and their origins.
#include <unistd.h>

#include <CLI/CLI.hpp>
#include <algorithm>
#include <cstdlib>
#include <memory>
#include <string_view>
#include <vector>

#include "cli/shared/checks.hpp"
#include "cli/shared/commands.hpp"
#include "cli/shared/report.hpp"
#include "cli/shared/settings.hpp"

namespace voxelume::cli {
namespace {

/// One row for each setting: name, variable, value (null: the default) and origin.
Report rows_of_settings() {
    Report rows = Report::array();
    for (const SettingValue& value : loaded_settings()) {
        const bool is_default = value.origin == "default";
        rows.push_back({{"name", value.setting->name},
                        {"variable", value.setting->variable},
                        {"value", is_default ? Report(nullptr) : Report(value.value)},
                        {"origin", value.origin}});
    }
    rows.push_back({{"name", "config"},
                    {"variable", "VOXELUME_CONFIG"},
                    {"value", settings_file().string()},
                    {"origin", settings_file_origin()}});
    return rows;
}

/// The variables of other programs and their values.
Report rows_of_shared_variables() {
    Report rows = Report::array();
    for (const SharedVariable& shared : shared_variables()) {
        const char* value = std::getenv(shared.variable);
        rows.push_back({{"variable", shared.variable},
                        {"value", value == nullptr ? Report(nullptr) : Report(value)},
                        {"meaning", shared.help}});
    }
    return rows;
}

/// Variables that are named like settings but aren't settings: otherwise a typing error would go
/// unnoticed.
Report unknown_variables() {
    std::vector<std::string_view> known = {"VOXELUME_CONFIG"};
    for (const Setting& setting : settings()) known.emplace_back(setting.variable);
    Report unknown = Report::array();
    for (char** entry = environ; *entry != nullptr; ++entry) {
        const std::string_view text = *entry, name = text.substr(0, text.find('='));
        if (name.starts_with("VOXELUME_") && std::ranges::find(known, name) == known.end())
            unknown.push_back(fmt::format("{} isn't read{}", name, suggest(name, known)));
    }
    return unknown;
}

/// The effective value of a row, for people.
std::string shown_value(const Report& row) {
    if (!row["value"].is_null()) return quote(row["value"].get<std::string>());
    for (const Setting& setting : settings())
        if (row.value("name", "") == setting.name) return setting.default_text;
    return "not set";
}

void print_rows(const Report& rows, const char* first, const char* last, size_t min) {
    size_t width = min, names = 0;
    for (const Report& row : rows) {
        width = std::max(width, shown_value(row).size());
        names = std::max(names, row[first].get_ref<const std::string&>().size());
    }
    for (const Report& row : rows)
        fmt::print("  {:<{}}  {:<{}}  {}\n", row[first].get<std::string>(), names, shown_value(row),
                   width, row[last].get<std::string>());
}

int print_settings(bool as_json) {
    const Report rows = rows_of_settings(), shared = rows_of_shared_variables();
    const std::filesystem::path file = settings_file();
    if (as_json) {
        print_report({{"file", file.string()},
                      {"settings", rows},
                      {"environment", shared},
                      {"unknown", unknown_variables()}},
                     true);
        return 0;
    }
    print_rows(rows, "name", "origin", 26);
    std::error_code error;
    if (!file.empty() && !std::filesystem::exists(file, error))
        fmt::print("\nNo file {}; lines such as `device = cpu` in it would be settings.\n",
                   file.string());
    for (const Report& unknown : unknown_variables())
        fmt::print("\n{}\n", unknown.get<std::string>());
    fmt::print("\nOther variables that count:\n");
    print_rows(shared, "variable", "meaning", 7);
    return 0;
}

}  // namespace

Action add_config(CLI::App& app) {
    const auto json = std::make_shared<bool>(false);
    app.add_flag("--json", *json, "print the settings as JSON");
    return [json] { return print_settings(*json); };
}

}  // namespace voxelume::cli
