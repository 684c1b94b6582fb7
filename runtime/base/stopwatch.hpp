// SPDX-License-Identifier: Apache-2.0
// How long parts of a run take.
#pragma once

#include <chrono>

namespace voxelume {

/// Adds the time until each `stop`, from its start or the last one, to a sum of seconds.
class Stopwatch {
  public:
    explicit Stopwatch(double& seconds) : seconds_(seconds) {}
    void stop() {
        seconds_ += std::chrono::duration<double>(Clock::now() - start_).count();
        start_ = Clock::now();
    }

  private:
    using Clock = std::chrono::steady_clock;
    double& seconds_;
    Clock::time_point start_ = Clock::now();
};

}  // namespace voxelume
