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

/// What a matte is made in, rank after rank.
struct MatteArrays {
    Buffer<uint32_t> numbers;  ///< number of the object or material plus 1
    Buffer<float> shares;      ///< of the pixel
};

/// The arrays of the mattes that the channels have.
std::vector<MatteArrays> allocate_mattes(const Device& device, const glm::ivec2& size,
                                         const ImageChannels& channels);

/// Kernels of matte.cl and the mattes they fill, batch by batch. Nothing is compiled or allocated
/// where the channels have no matte.
class MatteStage {
  public:
    MatteStage(const Device& device, const Features& features, const Camera& camera,
               const Scene& scene);

    /// Ranks what the pixels of `tiles` tiles from `first_tile` on show.
    void pixels(const RayBatch& batch, uint32_t first_tile, uint32_t tiles);

    /// Adds the planes and their attributes to an image, after every tile was ranked.
    void add_to(Image& image) const;

  private:
    struct Matte {
        std::string layer;               ///< of channels: "CryptoObject"
        uint32_t shift = 0, mask = 0;    ///< of its field of packed attributes
        std::vector<std::string> names;  ///< by number
    };

    static std::vector<Matte> mattes_of(const Scene& scene);

    Camera camera_;
    std::vector<Matte> mattes_;
    std::vector<MatteArrays> arrays_;
    std::optional<Program> program_;
    std::optional<Kernel> rank_;
};

}  // namespace voxelume
