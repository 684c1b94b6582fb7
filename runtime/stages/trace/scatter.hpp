// SPDX-License-Identifier: Apache-2.0
// surface points -> the rays that they spawn, and the light that these return.
#pragma once

#include <functional>

#include "kernels/shared/scene.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/trace/trace.hpp"

namespace voxelume {

/// The counters of kernels that spawn rays, as in kernels/lib/light/paths.h.
inline constexpr uint32_t kCountLayer = 0, kCountChildren = 1, kCountEnded = 2, kPathCounters = 3;
inline constexpr uint32_t kCountToEmitters = kCountLayer;  ///< global light has no layers

/// The reflected and refracted rays of a batch: their node numbers in the next depth.
struct Children {
    Buffer<uint32_t> nodes;  ///< node of each entry's reflected ray; `stride` later that of its
                             ///< refracted ray
    Buffer<float> child_weights;  ///< the part of the child node's light that the surface returns;
                                  ///< followed, with VXL_TINTED, by the colours of mirrored light
    Buffer<float> node_weights;   ///< 3: the weight of that light in the entry's node
};

/// VXL_CHILDREN_PARAMETERS of kernels.
void bind(KernelArguments& to, const Children& children);

/// The sums of light at nodes.
struct NodeLight {
    Buffer<float> radiance;  ///< 3, `stride` apart
    Buffer<float> coverage;  ///< empty below the first depth
    uint32_t stride = 0;
};

/// VXL_NODE_PARAMETERS of kernels.
void bind(KernelArguments& to, const NodeLight& nodes);

/// Called for each layer of surfaces along an observer's rays, the nearest first, after its light
/// was added to the nodes. Entry n of the first layer is ray n; entries of later layers have their
/// ray's number in `paths`.
using LayerSink =
    std::function<void(const RayBatch& entries, uint32_t count, bool is_first, const NodeLight&)>;

/// The kernels of scatter.cl for one feature set: the paper's blocks 6.1 to 9.
class ScatterStage {
  public:
    /// With `compact` = false every surface point gets a slot for each of its possible rays, used
    /// or not. This serves to measure the gain of compaction.
    ScatterStage(const Device& device, const Features& features, Surroundings surroundings,
                 float min_weight, bool compact);

    /// Starts a path for each of the rays 0 .. count-1, which come from an observer.
    void begin(const Pyramid& pyramid, RayBatch& batch, uint32_t count);

    /// Adds a layer to its nodes and writes the rays that continue straight to `next`, which has a
    /// slot for each node. Returns the number of these rays.
    uint32_t layer(const Pyramid& pyramid, RayBatch& entries, uint32_t count, bool first_layer,
                   Children& children, NodeLight& nodes, RayQueue& next);

    /// Writes the reflected and refracted rays of entries begin .. end-1 to `queue`. Returns their
    /// number.
    uint32_t rays(const Pyramid& pyramid, RayBatch& entries, uint32_t begin, uint32_t end,
                  Children& children, RayBatch& queue);

    /// Adds the light of the children's nodes to the nodes of entries begin .. end-1.
    void gather(const RayBatch& entries, uint32_t begin, uint32_t end, const Children& children,
                const NodeLight& child_nodes, NodeLight& nodes);

    /// Sets the analytic solids that transmit light: the numbers of their first records.
    void set_bodies(Buffer<uint32_t> solids) { bodies_ = std::move(solids); }

    uint64_t ended() const { return ended_; }  ///< paths that ended because of their small weight

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
