// SPDX-License-Identifier: Apache-2.0
// scene whose image is larger than memory -> the bands of rows in which it is rendered.
#pragma once

#include <optional>
#include <span>

#include "runtime/memory/frame_plans.hpp"

namespace voxelume {

/// Bands of an image, one below the other: all have the same rows, but perhaps the last.
struct ImageBands {
    int rows = 0;  ///< of each; a multiple of kBandRows where there are several
    int count = 1;
    bool are_needed = false;  ///< the whole image is refused; otherwise it may fit, too

    bool are_one() const { return count == 1; }
};

/// The scene whose image is a band of the scene's, from 0 on.
Scene band_of(const Scene& scene, const ImageBands& bands, int band);

/// The bands in which the scene's image is rendered in all frames: one if the whole image fits, and
/// otherwise as few as fit, by halves, with all that a plan expects, or with the minimum of it.
/// One, too, where none fit: then the plan of the whole says what is too large. An image that takes
/// little next to its world isn't planned here. `at_once` is the number of devices that render
/// bands at once.
///
/// Throws as plan_frames does.
ImageBands bands_that_fit(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                          const DeviceInfo& device, int at_once = 1);

/// Why an image is rendered as a whole or not at all, in half a sentence, and what to do.
struct NeedOfWhole {
    const char* reason;
    const char* advice;
};

/// Why images with these settings are; empty if they aren't.
std::optional<NeedOfWhole> need_of_whole(const RenderSettings& render);

/// Throws Error::limit for an image that doesn't fit as a whole.
[[noreturn]] void refuse_bands(const Scene& scene, const DeviceInfo& device,
                               const NeedOfWhole& need);

}  // namespace voxelume
