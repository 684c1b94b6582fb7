// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/selector.hpp"

#include <algorithm>
#include <cctype>
#include <charconv>
#include <string>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

std::string lower(std::string_view text) {
    std::string result(text);
    std::ranges::transform(result, result.begin(),
                           [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
    return result;
}

}  // namespace

int parts_of_all(std::string_view selector) {
    if (lower(selector) == "all") return 1;
    if (!lower(selector).starts_with("all/")) return 0;
    int parts = 0;
    const char* end = selector.data() + selector.size();
    const auto [stop, error] = std::from_chars(selector.data() + 4, end, parts);
    if (stop != end || error != std::errc() || parts < 1)
        throw Error(ErrorKind::usage,
                    "no device is named \"{}\"; write \"all\" for all of them, or \"all/2\" to cut "
                    "the CPU in two",
                    selector);
    return parts;
}

bool names_one_device(std::string_view selector) {
    const std::string wanted = lower(selector);
    return wanted != "auto" && wanted != "cpu" && wanted != "gpu" && parts_of_all(wanted) == 0;
}

bool names_device(std::string_view selector, const DeviceInfo& info) {
    const std::string wanted = lower(selector);
    if (wanted == "auto" || parts_of_all(wanted) > 0) return true;
    if (wanted == "cpu") return info.kind == DeviceKind::cpu;
    if (wanted == "gpu") return info.kind == DeviceKind::gpu;
    int index = -1;
    const char* end = wanted.data() + wanted.size();
    if (std::from_chars(wanted.data(), end, index).ptr == end) return info.index == index;
    return lower(info.name).find(wanted) != std::string::npos ||
           lower(info.platform).find(wanted) != std::string::npos;
}

}  // namespace voxelume
