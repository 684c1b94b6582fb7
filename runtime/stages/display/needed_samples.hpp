// SPDX-License-Identifier: Apache-2.0
// How stages of displays ask for as many samples of rays' light as these need.
#pragma once

#include <algorithm>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace voxelume {

/// Lights samples `first` .. `first + count - 1` of rays, without those in groups of sixteen for
/// which `wanted` has 0. Returns four means over the samples for each ray: of three colours times
/// weights, and of weights. A ray without anything to light has weight 0.
using LightSamples = std::function<std::vector<float>(uint32_t first, uint32_t count,
                                                      std::span<const uint32_t> wanted)>;

/// Returns the means over as many samples of the light of `rays` rays as they need. About `aimed`
/// of them may meet something.
using NeededSamples =
    std::function<std::vector<float>(uint32_t rays, uint32_t aimed, const LightSamples& light)>;

/// Calls `use` with the first ray and the number of rays of each run of groups that are wanted, of
/// `rays` rays in all.
template <class Use>
void for_wanted(std::span<const uint32_t> wanted, uint32_t rays, const Use& use) {
    for (uint32_t group = 0; group < wanted.size();) {
        const uint32_t first = group;
        while (group < wanted.size() && wanted[group] == wanted[first]) ++group;
        if (wanted[first]) use(16 * first, std::min(16 * group, rays) - 16 * first);
    }
}

}  // namespace voxelume
