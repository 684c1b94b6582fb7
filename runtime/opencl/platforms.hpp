// SPDX-License-Identifier: Apache-2.0
// The devices of all OpenCL platforms, for device.cpp to choose from.
#pragma once

#include <CL/opencl.hpp>

#include <string_view>
#include <vector>

#include "runtime/opencl/device.hpp"

namespace voxelume {

struct Candidate {
    cl::Device device;
    DeviceInfo info;
};

/// Every device that answers. A platform that is broken or empty is skipped.
std::vector<Candidate> find_candidates();

/// The best usable candidate that `selector` (auto, cpu, gpu, an index, part of a name) names.
/// Throws Error::device if there is none; the message names the devices that exist or the package
/// to install.
const Candidate& choose(const std::vector<Candidate>& candidates, std::string_view selector);

/// The candidates that share work: every usable GPU, and the best usable CPU divided into
/// `cpu_parts` equal parts. Throws Error::device if there is none or if the CPU can't be divided
/// so.
std::vector<Candidate> choose_all(const std::vector<Candidate>& candidates, int cpu_parts);

}  // namespace voxelume
