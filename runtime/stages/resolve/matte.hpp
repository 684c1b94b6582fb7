// SPDX-License-Identifier: Apache-2.0
// samples -> mattes: Cryptomatte's channels of objects and of materials.
#pragma once

#include <optional>
#include <string>
#include <vector>

#include "kernels/shared/scene.h"
#include "runtime/image/image.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The ranks of a matte's pixels.
struct MatteArrays {
    Buffer<uint32_t> numbers;  ///< number of the object or material plus 1
    Buffer<float> shares;      ///< parts of the pixel
};

/// The arrays of the mattes among the channels. With `adds_samples`, they have more ranks than have
/// names.
std::vector<MatteArrays> allocate_mattes(const Device& device, const glm::ivec2& size,
                                         const ImageChannels& channels, bool adds_samples = false);

/// Kernels of matte.cl and the mattes they fill, batch by batch. Without a matte among the channels
/// nothing is compiled or allocated.
class MatteStage {
  public:
    /// Makes the mattes in these arrays. With `adds_samples` the camera's samples are added to
    /// those in the arrays.
    MatteStage(const Device& device, const Features& features, const Camera& camera,
               const Scene& scene, std::vector<MatteArrays> arrays, bool adds_samples);

    /// Ranks the objects and materials in the pixels of `tiles` tiles from `first_tile` on.
    void pixels(const RayBatch& batch, uint32_t first_tile, uint32_t tiles);

  private:
    struct Field {
        uint32_t shift, mask;
    };

    static std::vector<Field> fields_of(const ImageChannels& channels);

    Camera camera_;
    std::vector<Field> fields_;  ///< field of packed attributes of each matte
    std::vector<MatteArrays> arrays_;
    std::optional<Program> program_;
    std::optional<Kernel> rank_;
};

/// Adds the planes of mattes and their attributes to an image, after every tile was ranked.
void add_mattes(const std::vector<MatteArrays>& arrays, const Scene& scene, Image& image);

}  // namespace voxelume
