// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_mean.hpp"

namespace voxelume {

Buffer<float> allocate_light_sums(const Device& device, uint32_t rays) {
    return {device, "display means", 3 * size_t(rays)};
}

DisplayMeanStage::DisplayMeanStage(const Device& device, const Features& features, uint32_t rays,
                                   uint32_t paths)
    : paths_(paths),
      sums_(allocate_light_sums(device, rays)),
      add_(Program(device, "display/display_mean.cl", features.defines(device))
               .kernel("add_paths")) {}

void DisplayMeanStage::add(uint32_t path, RayBatch& batch, uint32_t count) {
    add_.launch(WorkItem::light, count, count, batch.stride, path, paths_, sums_, batch.radiance);
}

}  // namespace voxelume
