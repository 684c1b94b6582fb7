// SPDX-License-Identifier: Apache-2.0
// Which process made a temporary file, in its name.
#pragma once

#include <string>
#include <string_view>

namespace voxelume {

/// `HOST.PID.START` of this process; START is when it started, in ticks of the system's clock,
/// since numbers of processes are used again.
std::string process_tag();

/// True if a name ends with the tag of a process of this host that has ended. False for
/// processes of other hosts, of which nothing is known, and for names without a tag.
bool ends_with_dead_tag(std::string_view name);

}  // namespace voxelume
