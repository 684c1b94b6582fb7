// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/device_call.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <mutex>
#include <vector>

namespace voxelume {
namespace {

struct Calls {
    std::mutex mutex;
    std::vector<const DeviceCall*> running;  ///< in the order in which they began
};

/// Never destroyed: a watching thread may use it when the process ends.
Calls& calls() {
    static auto* const all = new Calls;
    return *all;
}

}  // namespace

DeviceCall::DeviceCall(const DeviceInfo& device, const char* before, const std::string& name,
                       const char* after)
    : device_(device),
      before_(before),
      name_(name),
      after_(after),
      start_(std::chrono::steady_clock::now()) {
    const std::lock_guard lock(calls().mutex);
    calls().running.push_back(this);
}

DeviceCall::~DeviceCall() {
    const std::lock_guard lock(calls().mutex);
    std::erase(calls().running, this);
}

std::optional<std::string> late_call(std::chrono::duration<double> limit) {
    const std::lock_guard lock(calls().mutex);
    if (calls().running.empty()) return std::nullopt;
    const DeviceCall& call = *calls().running.front();
    const std::chrono::duration<double> time = std::chrono::steady_clock::now() - call.start_;
    if (time <= limit) return std::nullopt;
    return fmt::format(
        "\"{}\" has not answered for {:.3g} seconds while {}{}{}: it hangs, or "
        "needs more time than it was given",
        call.device_.name, time.count(), call.before_, call.name_, call.after_);
}

}  // namespace voxelume
