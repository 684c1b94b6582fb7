// SPDX-License-Identifier: Apache-2.0
// The time that a block of code takes, added to a sum.
#pragma once

#include <chrono>

namespace voxelume {

/// Adds the time from its construction to its destruction to a sum of seconds.
class LoadTimer {
  public:
    explicit LoadTimer(double& sum) : sum_(sum) {}
    ~LoadTimer() { sum_ += seconds(); }
    LoadTimer(const LoadTimer&) = delete;
    LoadTimer& operator=(const LoadTimer&) = delete;

    double seconds() const {
        return std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
    }

  private:
    double& sum_;
    std::chrono::steady_clock::time_point start_ = std::chrono::steady_clock::now();
};

}  // namespace voxelume
