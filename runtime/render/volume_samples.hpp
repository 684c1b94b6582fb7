// SPDX-License-Identifier: Apache-2.0
// light of a volumetric image's rays -> the mean of as many samples of it as a target of noise asks
// for.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/render/noise.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/display/needed_samples.hpp"

namespace voxelume {

/// Doubles the samples of each group of sixteen rays until the halves of them agree, as images do
/// with their tiles. A group's bits depend on no other group.
class SamplesByNoise {
  public:
    /// The image sends about `rays` rays for each sample, among which its time is divided. What a
    /// part of them leaves is for those that follow.
    SamplesByNoise(const RenderSettings& render, uint64_t rays);

    /// The means of the light of `rays` rays, of which `aimed` may meet something: the sums of one
    /// sample.
    std::vector<float> mean(uint32_t rays, uint32_t aimed, const LightSamples& light);

    const NoiseReached& reached() const { return reached_; }

  private:
    NoiseTarget target_;
    int maximum_;
    double seconds_left_;
    uint64_t rays_left_;
    NoiseReached reached_;
};

}  // namespace voxelume
