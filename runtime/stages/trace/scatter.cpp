#include "runtime/stages/trace/scatter.hpp"

namespace voxelume {
namespace {

// Numbers in `counters`, as scatter.cl has them.
constexpr uint32_t kCountLayer = 0, kCountChildren = 1, kCountEnded = 2;

}  // namespace

ScatterStage::ScatterStage(const Device& device, const Features& features,
                           Surroundings surroundings, float min_weight, bool compact)
    : surroundings_(std::move(surroundings)),
      min_weight_(min_weight),
      compact_(compact),
      branches_(features.refracts ? 2 : 1),
      counters_(device, "path counters", 3),
      program_(device, "scatter.cl", features.defines(device)),
      begin_(program_.kernel("begin_paths")),
      layer_(program_.kernel("pass_layer")),
      rays_(program_.kernel("scatter_rays")),
      gather_(program_.kernel("gather_light")) {}

void ScatterStage::begin(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    begin_.launch_packets(count, pyramid.solids, uint32_t(bodies_.size()), bodies_,
                          surroundings_.ranks, surroundings_.medium_overflows, batch.rays, count,
                          batch.stride, batch.paths, batch.starts, batch.inside);
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
    layer_.launch_packets(
        count, surroundings_.materials, surroundings_.ranks, surroundings_.medium_overflows,
        pyramid.colors, min_weight_, uint32_t(first_layer), entries.rays, entries.hits,
        entries.hit_attributes, entries.sides, entries.radiance, entries.transmittance,
        entries.paths, count, entries.stride, children.node_weights, nodes.radiance, nodes.coverage,
        nodes.stride, counters_, next.rays, next.paths, next.starts, next.inside, nodes.stride);
    return take(kCountLayer);
}

uint32_t ScatterStage::rays(const Pyramid& pyramid, RayBatch& entries, uint32_t begin, uint32_t end,
                            Children& children, RayBatch& queue) {
    counters_.fill(0);
    rays_.launch_packets(end - begin, shape_of(pyramid), surroundings_.materials,
                         surroundings_.ranks, surroundings_.medium_overflows, min_weight_,
                         uint32_t(compact_), entries.rays, entries.hits, entries.positions,
                         entries.normals, entries.hit_attributes, entries.sides,
                         entries.transmittance, children.node_weights, entries.paths, begin, end,
                         entries.stride, children.nodes, children.child_weights, counters_,
                         queue.rays, queue.paths, queue.starts, queue.inside, queue.stride);
    const uint32_t sent = take(kCountChildren);
    return compact_ ? sent : branches_ * (end - begin);
}

void ScatterStage::gather(const RayBatch& entries, uint32_t begin, uint32_t end,
                          const Children& children, const NodeLight& child_nodes,
                          NodeLight& nodes) {
    gather_.launch(WorkItem::light, end - begin, begin, end, entries.stride, children.nodes,
                   children.child_weights, children.node_weights, entries.transmittance,
                   entries.paths, child_nodes.radiance, child_nodes.stride, nodes.radiance,
                   nodes.stride);
}

}  // namespace voxelume
