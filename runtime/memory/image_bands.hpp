// SPDX-License-Identifier: Apache-2.0
// scene whose image is larger than memory -> the bands of rows in which it is rendered.
#pragma once

#include <optional>
#include <span>

#include "runtime/memory/frame_plans.hpp"

namespace voxelume {

/// Bands of an image, one below the other, with equal rows except perhaps the last.
struct ImageBands {
    int rows = 0;  ///< rows of each band; a multiple of kBandRows where there are several
    int count = 1;
    bool are_needed = false;  ///< true if the whole image is refused; otherwise it may fit, too

    bool are_one() const { return count == 1; }
};

/// The bytes of main memory of the whole process, where its device takes `device_bytes`, with what
/// an image takes while it is written.
double process_bytes(const Scene& scene, const ScenePlan& plan, double device_bytes,
                     const DeviceInfo& device);

/// The bytes of main memory of an image with all of its channels.
double kept_image_bytes(const Scene& scene);

/// The bytes of main memory that `views` views of a quilt take, which are kept or joined while
/// others are rendered. Throws Error::limit if they leave no memory for rendering.
uint64_t bytes_of_views(const Scene& scene, int views);

/// The scene whose image is band `band` of the scene's image, from 0 on.
Scene band_of(const Scene& scene, const ImageBands& bands, int band);

/// The bands in which the scene's image is rendered in all frames: one if the whole image fits, and
/// otherwise as few as fit, by halves; first by the expected memory of a plan, then by its minimum.
/// If none fit, there is one, too, and the plan of the whole says what is too large. An image that
/// takes little next to its world isn't planned here. `at_once` is the number of devices that
/// render bands at once.
///
/// Throws as plan_frames does.
ImageBands bands_that_fit(const Scene& scene, std::span<const int> frames, AssetStore& meshes,
                          const DeviceInfo& device, int at_once = 1);

/// The reason why an image can't be rendered in bands, in half a sentence, and a remedy.
struct NeedOfWhole {
    const char* reason;
    const char* advice;
};

/// The reason for images with these settings; empty if bands are possible.
std::optional<NeedOfWhole> need_of_whole(const RenderSettings& render);

/// Throws Error::limit for an image that doesn't fit as a whole.
[[noreturn]] void refuse_bands(const Scene& scene, const DeviceInfo& device,
                               const NeedOfWhole& need);

}  // namespace voxelume
