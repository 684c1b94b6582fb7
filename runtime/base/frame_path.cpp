// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/frame_path.hpp"

#include <fmt/format.h>

#include <regex>

namespace voxelume {

namespace {

/// `frame` as text, with leading zeros up to `width` characters; a minus sign counts as one.
std::string pad(int frame, size_t width) {
    return fmt::format("{:0{}d}", frame, width);
}

}  // namespace

std::string frame_path(const std::string& pattern, int frame, bool animation) {
    const size_t slash = pattern.rfind('/');
    const size_t name_start = slash == std::string::npos ? 0 : slash + 1;
    const std::string folder = pattern.substr(0, name_start);
    std::string name = pattern.substr(name_start);

    if (const size_t last = name.rfind('#'); last != std::string::npos) {
        const size_t before = last == 0 ? std::string::npos : name.find_last_not_of('#', last);
        const size_t first = before == std::string::npos ? 0 : before + 1;
        const size_t count = last - first + 1;
        return folder + name.replace(first, count, pad(frame, count));
    }
    static const std::regex kPrintf("%(0?)([1-9]?)d");
    if (std::smatch match; std::regex_search(name, match, kPrintf)) {
        const size_t width = match[2].length() == 0 ? 0 : static_cast<size_t>(std::stoi(match[2]));
        const std::string number = match[1].length() == 0 ? fmt::format("{:{}d}", frame, width)
                                                          : fmt::format("{:0{}d}", frame, width);
        return folder + match.prefix().str() + number + match.suffix().str();
    }
    if (!animation) return pattern;
    const size_t dot = name.rfind('.');
    const size_t end = dot == std::string::npos || dot == 0 ? name.size() : dot;
    // "v-1.png" must not become "v-10001.png", as if this were frame 10001.
    const bool ends_in_digit = end > 0 && name[end - 1] >= '0' && name[end - 1] <= '9';
    return folder + name.insert(end, fmt::format("{}{}", ends_in_digit ? "." : "", pad(frame, 4)));
}

}  // namespace voxelume
