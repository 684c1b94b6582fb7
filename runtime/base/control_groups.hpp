// SPDX-License-Identifier: Apache-2.0
// The control groups of a process, by which Linux limits containers and jobs of farms.
#pragma once

#include <filesystem>
#include <functional>
#include <string>

namespace voxelume {

/// The files in which Linux describes control groups.
struct ControlGroupFiles {
    std::filesystem::path groups = "/proc/self/cgroup";  ///< the process's groups
    std::filesystem::path mount = "/sys/fs/cgroup";      ///< the folder of all groups
};

/// The version of the interface that a group's files belong to.
enum class ControlGroupVersion { first, second };

/// Calls `visit` with the folder of each group that limits what a `controller` ("cpu", "memory")
/// gives the process: its groups of both versions, and the groups around them. Folders that don't
/// exist are among them, since a container often sees its own group as the root, while the group's
/// path is the one outside.
void visit_control_groups(
    const ControlGroupFiles& files, const std::string& controller,
    const std::function<void(const std::filesystem::path& folder, ControlGroupVersion)>& visit);

}  // namespace voxelume
