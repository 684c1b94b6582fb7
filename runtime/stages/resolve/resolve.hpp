// SPDX-License-Identifier: Apache-2.0
// samples -> pixels: the flat image.
#pragma once

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/image/image.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The build constants of the features, and those of resolve.cl alone.
Defines resolve_defines(const Device& device, const Features& features,
                        const ImageChannels& channels, bool adds_samples = false);

/// The arrays in which an image is made.
struct ImageArrays {
    Buffer<float> planes;         ///< one after another
    Buffer<uint32_t> ids;         ///< planes of the object's and the material's number plus 1
    Buffer<uint32_t> not_finite;  ///< how many values became 0; more than 0 is a fault of ours
};
ImageArrays allocate_image(const Device& device, const glm::ivec2& size,
                           const ImageChannels& channels);

/// Copies an earlier image, to which samples are to be added, into arrays of its size. Throws
/// Error::input if it lacks one of the channels, or has other pixels.
void begin_with(const Image& earlier, const ImageChannels& channels, ImageArrays& arrays);

/// The image of `size` pixels in these arrays, after every tile was computed. Waits for the device.
Image image_in(const ImageArrays& arrays, const glm::ivec2& size, const ImageChannels& channels);

/// Kernels of resolve.cl and the image they fill, batch by batch.
class ResolveStage {
  public:
    /// Makes the image in these arrays, of the `channels` that are asked for. Variance is that of
    /// colour, which must be asked for, too. With `adds_samples` the camera's samples are added to
    /// those in the arrays.
    ResolveStage(const Device& device, const Features& features, const Camera& camera,
                 const ImageChannels& channels, ImageArrays arrays, bool adds_samples);

    /// Computes the pixels of `tiles` tiles from `first_tile` on.
    void pixels(const Pyramid& pyramid, const RayBatch& batch, uint32_t first_tile, uint32_t tiles);

  private:
    Camera camera_;
    ImageArrays arrays_;
    Program program_;
    Kernel pixels_;
};

}  // namespace voxelume
