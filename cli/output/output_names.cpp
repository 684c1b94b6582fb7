// SPDX-License-Identifier: Apache-2.0
#include "cli/output/output_names.hpp"

#include <algorithm>
#include <string_view>

#include "cli/shared/checks.hpp"

namespace voxelume::cli {

std::string fill_in(const std::string& pattern, const Placeholders& placeholders,
                    const char* command) {
    std::string text;
    for (size_t i = 0; i < pattern.size();) {
        const size_t open = std::min(pattern.find('{', i), pattern.size());
        text += pattern.substr(i, open - i);
        if (open == pattern.size()) break;
        const size_t close = pattern.find('}', open);
        if (close == std::string::npos)
            fail_usage("{}: {}: a {{ without its }}; {{name}} is the name of the input", command,
                       pattern);
        const std::string name = pattern.substr(open + 1, close - open - 1);
        const auto found =
            std::ranges::find(placeholders, name, &std::pair<std::string, std::string>::first);
        if (found == placeholders.end()) {
            std::vector<std::string_view> names;
            for (const auto& [known, value] : placeholders) names.push_back(known);
            fail_usage("{}: {}: there is no placeholder {}{}", command, pattern, quote(name),
                       name == "eye" ? " without --stereo" : suggest(name, names));
        }
        text += found->second;
        i = close + 1;
    }
    return text;
}

std::string padded(size_t number, size_t largest) {
    return fmt::format("{:0{}}", number, std::to_string(largest).size());
}

}  // namespace voxelume::cli
