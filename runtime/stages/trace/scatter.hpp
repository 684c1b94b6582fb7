// surface points -> the rays that go on from them, and their light back.
#pragma once

#include <functional>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/trace.hpp"

namespace voxelume {

/// A batch's reflected and refracted rays: which nodes of the next depth they are.
struct Children {
    Buffer<uint32_t> nodes;       ///< of each entry's reflected ray; `stride` later its refracted
    Buffer<float> child_weights;  ///< of the nodes' light that the surface returns
    Buffer<float> node_weights;   ///< 3: what that light counts in the entry's node
};

/// The sums of light of nodes.
struct NodeLight {
    Buffer<float> radiance;  ///< 3, `stride` apart
    Buffer<float> coverage;  ///< empty below the first depth
    uint32_t stride = 0;
};

/// Called for each layer of surfaces along the rays of an observer, the nearest first, once its
/// light is added to the nodes. Entry n of the first layer is ray n; others name theirs in `paths`.
using LayerSink =
    std::function<void(const RayBatch& entries, uint32_t count, bool is_first, const NodeLight&)>;

/// Kernels of scatter.cl for one feature set. The paper's blocks 6.1 to 9.
class ScatterStage {
  public:
    /// `compact` = false gives every surface point a place for each of its rays, wanted or not: to
    /// measure what compaction is worth.
    ScatterStage(const Device& device, const Features& features, Surroundings surroundings,
                 float min_weight, bool compact);

    /// Makes rays 0 .. count-1, which come from an observer, paths of their own.
    void begin(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

    /// Adds a layer to its nodes and sends its straight rays into `next`, which has as many places
    /// as there are nodes; returns their number.
    uint32_t layer(const Pyramid& pyramid, RayBatch& entries, uint32_t count, bool first_layer,
                   Children& children, NodeLight& nodes, RayQueue& next);

    /// Sends the reflected and refracted rays of entries begin .. end-1 into `queue`; returns their
    /// number.
    uint32_t rays(const Pyramid& pyramid, RayBatch& entries, uint32_t begin, uint32_t end,
                  Children& children, RayBatch& queue);

    /// Adds to the nodes of entries begin .. end-1 what the children's nodes hold.
    void gather(const RayBatch& entries, uint32_t begin, uint32_t end, const Children& children,
                const NodeLight& child_nodes, NodeLight& nodes);

    /// Says which analytic solids transmit light: numbers of their first records.
    void set_bodies(Buffer<uint32_t> solids) { bodies_ = std::move(solids); }

    uint64_t ended() const { return ended_; }  ///< paths that ended for their small weight

  private:
    uint32_t take(uint32_t counter);

    Surroundings surroundings_;
    float min_weight_;
    bool compact_;
    uint32_t branches_;
    Buffer<uint32_t> counters_, bodies_;
    uint64_t ended_ = 0;
    Program program_;
    Kernel begin_, layer_, rays_, gather_;
};

}  // namespace voxelume
