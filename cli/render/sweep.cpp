// SPDX-License-Identifier: Apache-2.0
#include "cli/render/sweep.hpp"

#include <algorithm>
#include <cctype>

#include "cli/shared/checks.hpp"
#include "cli/shared/scene_options.hpp"

namespace voxelume::cli {
namespace {

/// Splits the text at commas that aren't inside brackets, braces or quotes.
std::vector<std::string> split_values(const std::string& text) {
    std::vector<std::string> values(1);
    int depth = 0;
    bool is_quoted = false, is_escaped = false;
    for (const char c : text) {
        if (c == '"' && !is_escaped) is_quoted = !is_quoted;
        is_escaped = c == '\\' && !is_escaped;
        if (!is_quoted) depth += int(c == '[' || c == '{') - int(c == ']' || c == '}');
        if (c == ',' && depth == 0 && !is_quoted)
            values.emplace_back();
        else
            values.back() += c;
    }
    return values;
}

}  // namespace

Sweep parse_sweep(const std::string& text, const char* command) {
    const SceneChange first = setting_of(text, "--sweep", command);
    Sweep sweep{first.path, split_values(first.value)};
    for (const std::string& value : sweep.values)
        if (value.empty())
            fail_usage(
                "{}: --sweep {}: there is an empty value next to a comma; give PATH=V1,V2, and "
                "lists as "
                "PATH=[1,2,3],[4,5,6]",
                command, text);
    for (size_t i = 0; i < sweep.values.size(); ++i)
        if (std::find(sweep.values.begin(), sweep.values.begin() + i, sweep.values[i]) !=
            sweep.values.begin() + i)
            fail_usage(
                "{}: --sweep {}: the value {} stands there twice; lists are written in brackets, "
                "PATH=[1,2,3],[4,5,6]",
                command, text, sweep.values[i]);
    return sweep;
}

std::vector<std::vector<std::string>> combinations(const std::vector<Sweep>& sweeps,
                                                   const char* command) {
    constexpr size_t kMaxCombinations = 1'000'000;
    std::vector<std::vector<std::string>> list(1);
    for (const Sweep& sweep : sweeps) {
        std::vector<std::vector<std::string>> longer;
        if (list.size() * sweep.values.size() > kMaxCombinations)
            fail_usage("{}: --sweep: more than {} combinations of values", command,
                       kMaxCombinations);
        for (const std::vector<std::string>& start : list)
            for (const std::string& value : sweep.values) {
                longer.push_back(start);
                longer.back().push_back(value);
            }
        list = std::move(longer);
    }
    return list;
}

std::string last_key(const std::string& path) {
    const size_t dot = path.find_last_of('.');
    return dot == std::string::npos ? path : path.substr(dot + 1);
}

std::string file_part(const std::string& value) {
    std::string part;
    for (const char c : value) {
        if (c == ' ' || c == '"' || c == '[' || c == ']') continue;
        const bool is_plain = std::isalnum(static_cast<unsigned char>(c)) != 0 || (c & 0x80) != 0 ||
                              std::string_view(".,+-_=").find(c) != std::string_view::npos;
        part += is_plain ? c : '_';
    }
    return part.empty() ? "_" : part;
}

}  // namespace voxelume::cli
