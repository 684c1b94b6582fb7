// SPDX-License-Identifier: Apache-2.0
// A compiler's log -> the lines that a message quotes.
#pragma once

#include <string>
#include <string_view>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// The first lines of a log that name errors, or of all its lines if none does, and the number of
/// further such lines. The first line comes without a line break, as lists of devices have one line
/// for each device. Empty for a log without lines.
std::string first_errors(std::string_view log);

/// Throws what a compiler's failure means for the user: a limit of file sizes, and a folder of
/// PoCL's that isn't there any more, are named, since drivers write files while they compile, and
/// don't say why they can't.
[[noreturn]] void fail_build(const std::string& label, const DeviceInfo& device,
                             std::string_view what);

}  // namespace voxelume
