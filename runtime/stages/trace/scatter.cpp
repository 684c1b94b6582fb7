// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {
void bind(KernelArguments& to, const Children& children) {
    to.add(children.nodes, children.child_weights, children.node_weights);
}

void bind(KernelArguments& to, const NodeLight& nodes) {
    to.add(nodes.radiance, nodes.coverage, nodes.stride);
}

ScatterStage::ScatterStage(const Device& device, const Features& features,
                           Surroundings surroundings, float min_weight, bool compact)
    : surroundings_(std::move(surroundings)),
      min_weight_(min_weight),
      compact_(compact),
      branches_(features.refracts ? 2 : 1),
      counters_(device, "path counters", kPathCounters),
      program_(device, "scatter.cl", features.defines(device)),
      begin_(program_.kernel("begin_paths")),
      layer_(program_.kernel("pass_layer")),
      rays_(program_.kernel("scatter_rays")),
      gather_(program_.kernel("gather_light")) {}

void ScatterStage::begin(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    begin_.launch_packets(count, shape_of(pyramid), pyramid.solids, uint32_t(bodies_.size()),
                          bodies_, surroundings_, batch, count);
}

uint32_t ScatterStage::take(uint32_t counter) {
    const std::vector<uint32_t> counts = counters_.read();
    ended_ += counts[kCountEnded];
    return counts[counter];
}

uint32_t ScatterStage::layer(const Pyramid& pyramid, RayBatch& entries, uint32_t count,
                             bool first_layer, Children& children, NodeLight& nodes,
                             RayQueue& next) {
    counters_.fill(0);
    layer_.launch_packets(count, shape_of(pyramid), surroundings_, pyramid.colors, min_weight_,
                          uint32_t(first_layer), entries, count, children.node_weights, nodes,
                          CountedQueue{counters_, next});
    return take(kCountLayer);
}

uint32_t ScatterStage::rays(const Pyramid& pyramid, RayBatch& entries, uint32_t begin, uint32_t end,
                            Children& children, RayBatch& queue) {
    counters_.fill(0);
    rays_.launch_packets(end - begin, shape_of(pyramid), surroundings_, min_weight_,
                         uint32_t(compact_), pyramid.colors, entries, begin, end, children,
                         CountedQueue{counters_, queue});
    const uint32_t sent = take(kCountChildren);
    return compact_ ? sent : branches_ * (end - begin);
}

void ScatterStage::gather(const RayBatch& entries, uint32_t begin, uint32_t end,
                          const Children& children, const NodeLight& child_nodes,
                          NodeLight& nodes) {
    gather_.launch(WorkItem::light, end - begin, begin, end, children, entries.transmittance,
                   entries.paths, entries.stride, child_nodes.radiance, child_nodes.stride,
                   nodes.radiance, nodes.stride);
}

}  // namespace voxelume
