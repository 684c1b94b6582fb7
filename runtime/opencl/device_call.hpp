// SPDX-License-Identifier: Apache-2.0
// Calls of drivers that have not returned yet, for code that watches whether devices answer.
#pragma once

#include <chrono>
#include <optional>
#include <string>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// A call of a driver that may take long, from its begin to the end of this object.
class DeviceCall {
  public:
    /// `before`, `name` and `after` together say what the device does, as in "reading the ",
    /// "hits", " buffer". They, and `device`, outlive the call.
    DeviceCall(const DeviceInfo& device, const char* before, const std::string& name,
               const char* after = "");
    ~DeviceCall();
    DeviceCall(const DeviceCall&) = delete;
    DeviceCall& operator=(const DeviceCall&) = delete;

  private:
    friend std::optional<std::string> late_call(std::chrono::duration<double> limit);

    const DeviceInfo& device_;
    const char* before_;
    const std::string& name_;
    const char* after_;
    std::chrono::steady_clock::time_point start_;
};

/// A sentence about the call that began first, if it has lasted longer than `limit`.
std::optional<std::string> late_call(std::chrono::duration<double> limit);

}  // namespace voxelume
