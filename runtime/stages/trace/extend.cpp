// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/extend.hpp"

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {

void bind(KernelArguments& to, const SoughtLight& sought) {
    to.add(sought.emitters, sought.sky, sought.queue);
}

ExtendStage::ExtendStage(const Device& device, const Features& features, Surroundings surroundings)
    : surroundings_(std::move(surroundings)),
      counters_(device, "path counters", kPathCounters),
      program_(device, "extend.cl", features.defines(device)),
      extend_(program_.kernel("extend_paths")) {}

NextRays ExtendStage::paths(const Pyramid& pyramid, const PathSampling& sampling,
                            const EmitterTable& emitters, RayBatch& entries, uint32_t count,
                            bool is_first, NodeLight& nodes, RayQueue& next,
                            RayQueue& to_emitters) {
    counters_.fill(0);
    extend_.launch_packets(count, shape_of(pyramid), surroundings_, pyramid.colors, sampling,
                           uint32_t(is_first), entries, count, nodes, CountedQueue{counters_, next},
                           SoughtLight{emitters, sky_, to_emitters});
    const std::vector<uint32_t> counts = counters_.read();
    return {counts[kCountChildren], counts[kCountToEmitters]};
}

}  // namespace voxelume
