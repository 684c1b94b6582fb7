// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

void bind(KernelArguments& to, const RayQueue& queue) {
    to.add(queue.rays, queue.paths, queue.starts, queue.inside, queue.stride);
}

void bind(KernelArguments& to, const CountedQueue& counted) {
    to.add(counted.counters, counted.queue);
}

void bind(KernelArguments& to, const RayBatch& batch) {
    bind(to, static_cast<const RayQueue&>(batch));
    to.add(batch.beams, batch.hits, batch.positions, batch.normals, batch.shading,
           batch.hit_attributes, batch.radiance, batch.sides, batch.transmittance, batch.coverage,
           batch.paint);
}

void bind(KernelArguments& to, const ShadowQueue& queue) {
    to.add(queue.count, queue.traced, queue.rays, queue.targets, queue.sources, queue.contributions,
           queue.beams.grid, queue.beams.ends);
}

}  // namespace voxelume
