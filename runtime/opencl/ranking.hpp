// SPDX-License-Identifier: Apache-2.0
// The choice of the device that most likely renders fastest.
#pragma once

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// What a device of this kind lacks, with that version text ("OpenCL 1.1 ...") and at most that
/// many work-items in a group; empty for one that can render.
std::string missing_ability(DeviceKind kind, std::string_view version, size_t largest_group);

/// True for a software rasterizer's device, which is used only if the user names it.
bool is_software(const DeviceInfo& info);

/// True for two drivers' views of one card.
bool are_one_card(const DeviceInfo& a, const DeviceInfo& b);

/// True if `a` most likely renders faster than `b`. GPUs go before other devices, those with memory
/// of their own before those that share the host's, and then more arithmetic a second: compute
/// units x floats that a unit handles at once x clock.
bool is_better(const DeviceInfo& a, const DeviceInfo& b);

/// True for a device that can render and that is used without being named.
bool is_usable(const DeviceInfo& info);

/// The number of the best usable device that `selector` (auto, cpu, gpu, an index, part of a name)
/// names. Throws Error::device if there is none; the message names the devices that exist or the
/// package to install.
size_t best_device(const std::vector<DeviceInfo>& devices, std::string_view selector);

/// The numbers of the usable GPUs, each card once.
std::vector<size_t> distinct_gpus(const std::vector<DeviceInfo>& devices);

}  // namespace voxelume
