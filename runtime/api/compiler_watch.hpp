// SPDX-License-Identifier: Apache-2.0
// Devices tell a caller of the kernels that they compile.
#pragma once

#include <span>

#include "runtime/opencl/device.hpp"

namespace voxelume {

/// Reports compilations to a caller as long as this object lives.
class CompilerWatch {
  public:
    CompilerWatch(std::span<const Device> devices, const CompileListener& listener)
        : devices_(devices) {
        for (const Device& device : devices_) device.listen_to_compiler(listener);
    }
    ~CompilerWatch() {
        for (const Device& device : devices_) device.listen_to_compiler({});
    }
    CompilerWatch(const CompilerWatch&) = delete;
    CompilerWatch& operator=(const CompilerWatch&) = delete;

  private:
    std::span<const Device> devices_;
};

}  // namespace voxelume
