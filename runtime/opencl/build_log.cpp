// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/build_log.hpp"

#include <fmt/format.h>
#include <sys/resource.h>

#include <algorithm>
#include <filesystem>
#include <span>
#include <system_error>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/opencl/quirks/driver_quirks.hpp"
#include "runtime/opencl/quirks/pocl_folder.hpp"

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

void fail_build(const std::string& label, const DeviceInfo& device, std::string_view what) {
    std::string cause;
    if (driver_quirks(device.platform).keeping == ProgramKeeping::pocl_folder) {
        const std::filesystem::path& folder = PoclFolder::instance().path();
        std::error_code error;
        if (!folder.empty() && !std::filesystem::exists(folder, error))
            cause =
                fmt::format("; its folder {} was removed meanwhile: run it again", folder.string());
    }
    rlimit limit{};
    if (getrlimit(RLIMIT_FSIZE, &limit) == 0 && limit.rlim_cur != RLIM_INFINITY)
        cause += fmt::format(
            "; drivers write files while they compile, which may have at most {} kB here: raise "
            "`ulimit -f`",
            limit.rlim_cur / 1000);
    throw Error(ErrorKind::build, "{} does not compile on \"{}\": {}{}", label, device.name, what,
                cause);
}

}  // namespace voxelume
