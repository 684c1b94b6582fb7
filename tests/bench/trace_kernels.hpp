// SPDX-License-Identifier: Apache-2.0
// Runs the kernels of one feature set on lists of rays, and times them.
#pragma once

#include <algorithm>
#include <vector>

#include "runtime/render/illumination.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "tests/bench/cpu_time.hpp"
#include "tests/bench/trace_rays.hpp"

namespace voxelume {

/// Median CPU seconds of seven passes, after a warm-up pass that builds the kernel.
template <class Pass>
double median_seconds(const Pass& pass) {
    constexpr int kRuns = 7;
    std::vector<double> seconds;
    for (int run = 0; run <= kRuns; ++run) {
        const double start = busy_seconds();
        pass();
        seconds.push_back(busy_seconds() - start);
    }
    seconds.erase(seconds.begin());
    return median_of(std::move(seconds));
}

/// A batch that holds the rays as a frame's stages would pass them on.
RayBatch batch_of(const Device& device, const Features& features, const Pyramid& pyramid,
                  const std::vector<Ray>& rays);

/// The hits of the batch's rays.
std::vector<Hit> hits_of(const RayBatch& batch, size_t count);

/// Sends each list through the kernel that a frame uses for such rays. Rates are in million rays
/// per second and core. The pyramid must outlive this.
class TraceKernels {
  public:
    TraceKernels(const Device& device, const Pyramid& pyramid);

    double sight(const std::vector<Ray>& rays, std::vector<Hit>* hits = nullptr);
    double bounce(const std::vector<Ray>& rays);
    /// The rate of shadow rays, with the beams of their light.
    double shadow(const std::vector<Ray>& rays);

    /// The hash of the closest hits of all lists so far.
    uint64_t hash() const { return hash_; }

  private:
    double rate(const std::vector<Ray>& rays, double seconds, const RayBatch& batch);

    Device device_;
    const Pyramid& pyramid_;
    Features direct_, bouncing_;
    DilatedOccupancy dilated_occupancy_;
    BeamStage beams_;
    uint64_t hash_ = 0;
};

}  // namespace voxelume
