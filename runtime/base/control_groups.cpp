// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/control_groups.hpp"

#include <fmt/format.h>

#include <fstream>
#include <system_error>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// The folder of version 2's groups: where those of version 1 are mounted, too, it has a name.
fs::path folder_of_version_2(const fs::path& mount) {
    std::error_code error;
    const fs::path named = mount / "unified";
    return fs::exists(named / "cgroup.controllers", error) ? named : mount;
}

}  // namespace

void visit_control_groups(
    const ControlGroupFiles& files, const std::string& controller,
    const std::function<void(const fs::path& folder, ControlGroupVersion)>& visit) {
    const std::string listed = fmt::format(",{},", controller);
    std::ifstream groups(files.groups);
    // Lines look like "4:cpu,cpuacct:/job" in version 1 and "0::/job" in version 2.
    for (std::string line; std::getline(groups, line);) {
        const size_t first = line.find(':'), second = line.find(':', first + 1);
        if (second == std::string::npos) continue;
        const auto controllers = fmt::format(",{},", line.substr(first + 1, second - first - 1));
        const bool is_second = controllers == ",,";
        if (!is_second && controllers.find(listed) == std::string::npos) continue;
        const auto version = is_second ? ControlGroupVersion::second : ControlGroupVersion::first;
        fs::path folder = is_second ? folder_of_version_2(files.mount) : files.mount / controller;
        visit(folder, version);
        for (const fs::path& part : fs::path(line.substr(second + 1)).relative_path())
            visit(folder /= part, version);
    }
}

}  // namespace voxelume
