// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/build_log.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <span>
#include <vector>

namespace voxelume {

std::string first_errors(std::string_view log) {
    constexpr size_t kMaxErrors = 5, kLongest = 200;
    std::vector<std::string_view> lines, errors;
    for (size_t begin = 0; begin < log.size();) {
        const size_t end = std::min(log.find('\n', begin), log.size());
        const std::string_view line = log.substr(begin, end - begin);
        if (line.find_first_not_of(" \t\r") != std::string_view::npos) lines.push_back(line);
        if (line.find("error:") != std::string_view::npos) errors.push_back(line);
        begin = end + 1;
    }
    if (errors.empty()) errors = lines;
    std::string text;
    for (const std::string_view line : std::span(errors).first(std::min(errors.size(), kMaxErrors)))
        text += fmt::format("{}{}{}", text.empty() ? "" : "\n  ", line.substr(0, kLongest),
                            line.size() > kLongest ? "..." : "");
    if (errors.size() > kMaxErrors)
        text += fmt::format("\n  and {} more", errors.size() - kMaxErrors);
    return text;
}

}  // namespace voxelume
