// SPDX-License-Identifier: Apache-2.0
#include "cli/shared/settings.hpp"

#include <algorithm>
#include <cstdlib>
#include <map>
#include <sstream>
#include <string_view>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {
namespace {

namespace fs = std::filesystem;

struct FileValue {
    std::string value;
    int line = 0;
};

std::string trimmed(const std::string& text) {
    const size_t first = text.find_first_not_of(" \t\r");
    if (first == std::string::npos) return {};
    return text.substr(first, text.find_last_not_of(" \t\r") - first + 1);
}

/// The value on a line's right side, which may be in quotes.
std::string value_of(const std::string& text) {
    const bool is_quoted = text.size() >= 2 && text.front() == '"' && text.back() == '"';
    return is_quoted ? text.substr(1, text.size() - 2) : text;
}

/// The value with "~" replaced by the home folder wherever it stands before a slash, at the
/// beginning or after a colon.
std::string with_home(const std::string& value) {
    const char* home = std::getenv("HOME");
    if (home == nullptr) return value;
    std::string text;
    for (size_t i = 0; i < value.size(); ++i)
        if (value.compare(i, 2, "~/") == 0 && (i == 0 || value[i - 1] == ':'))
            text += home;
        else
            text += value[i];
    return text;
}

/// Throws Error::usage for a value that the setting can't have. An empty value counts as not set.
void check(const Setting& setting, const std::string& value, const std::string& origin) {
    if (value.empty() || setting.fault == nullptr) return;
    if (const std::string fault = setting.fault(value); !fault.empty())
        fail_usage("{}: {}", origin, fault);
}

std::string text_of(const fs::path& file) {
    constexpr uint64_t kMaxBytes = uint64_t{1} << 20;
    try {
        return voxelume::read_file(file, kMaxBytes);
    } catch (const Error& error) {
        fail_usage("{}", error.what());
    }
}

/// Reads lines "name = value"; # begins a comment line.
std::map<std::string, FileValue> read_file(const fs::path& file) {
    std::istringstream stream(text_of(file));
    std::map<std::string, FileValue> values;
    std::vector<std::string_view> names;
    for (const Setting& setting : settings()) names.emplace_back(setting.name);
    int number = 0;
    for (std::string line; std::getline(stream, line);) {
        ++number;
        line = trimmed(line);
        if (line.empty() || line.front() == '#') continue;
        const size_t sign = line.find('=');
        const std::string name = trimmed(line.substr(0, sign));
        if (sign == std::string::npos)
            fail_usage("{}:{}: {}: give a setting as NAME = VALUE", file.string(), number,
                       quote(line));
        const auto setting = std::ranges::find(settings(), name, &Setting::name);
        if (setting == settings().end())
            fail_usage("{}:{}: no setting named {}{}", file.string(), number, quote(name),
                       suggest(name, names));
        FileValue value{value_of(trimmed(line.substr(sign + 1))), number};
        if (name == "assets" || name == "cache_dir") value.value = with_home(value.value);
        check(*setting, value.value, fmt::format("{}:{}: {}", file.string(), number, name));
        const auto [known, is_new] = values.emplace(name, value);
        if (!is_new)
            fail_usage("{}:{}: {} is set already in line {}", file.string(), number, name,
                       known->second.line);
    }
    return values;
}

/// The value of an environment variable, perhaps empty; null if it is not set.
const char* environment(const char* name) {
    return std::getenv(name);
}

std::vector<SettingValue>& loaded() {
    static std::vector<SettingValue> values;
    return values;
}

}  // namespace

std::string settings_file_origin() {
    if (environment("VOXELUME_CONFIG") != nullptr) return "VOXELUME_CONFIG";
    const char* shared = environment("XDG_CONFIG_HOME");
    return shared != nullptr && fs::path(shared).is_absolute() ? "XDG_CONFIG_HOME" : "HOME";
}

fs::path settings_file() {
    const std::string origin = settings_file_origin();
    const char* value = environment(origin.c_str());
    if (origin == "VOXELUME_CONFIG") return value;
    if (origin == "XDG_CONFIG_HOME") return fs::path(value) / "voxelume" / "config";
    return value != nullptr && *value != '\0' ? fs::path(value) / ".config" / "voxelume" / "config"
                                              : fs::path();
}

namespace {

/// Stores every setting's value, and puts the values of the file into the environment.
void take(const fs::path& file, const std::map<std::string, FileValue>& values) {
    loaded().clear();
    for (const Setting& setting : settings()) {
        const auto in_file = values.find(setting.name);
        if (const char* value = environment(setting.variable)) {
            loaded().push_back({&setting, value, setting.variable});
        } else if (in_file != values.end()) {
            const FileValue& found = in_file->second;
            loaded().push_back(
                {&setting, found.value, fmt::format("{}:{}", file.string(), found.line)});
            setenv(setting.variable, found.value.c_str(), 1);
        } else {
            loaded().push_back({&setting, {}, "default"});
        }
    }
}

}  // namespace

void load_settings() {
    const fs::path file = settings_file();
    std::error_code error;
    take(file, {});  // these values hold if the file is wrong
    if (!file.empty() && fs::is_regular_file(file, error))
        take(file, read_file(file));
    else if (!file.empty() && environment("VOXELUME_CONFIG") != nullptr)
        fail_usage("VOXELUME_CONFIG is {}: {}", quote(file.string()),
                   fs::exists(file, error) ? "it isn't a plain file" : "there is no such file");
    for (const Setting& setting : settings())
        if (const char* value = environment(setting.variable))
            check(setting, value, fmt::format("{}={}", setting.variable, value));
}

const std::vector<SettingValue>& loaded_settings() {
    return loaded();
}

}  // namespace voxelume::cli
