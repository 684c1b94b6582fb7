// SPDX-License-Identifier: Apache-2.0
// many lights -> a tree of them; surface points -> radiance from one light each that they choose.
#pragma once

#include <span>
#include <vector>

#include "kernels/shared/light_tree.h"
#include "kernels/shared/paths.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light/light.hpp"
#include "runtime/stages/light_tree_table.hpp"
#include "runtime/stages/ray_batch.hpp"

namespace voxelume {

/// The tables for `count` lights.
LightTree allocate_light_tree(const Device& device, size_t count, bool has_areas);

/// The main memory for making the tree of `count` lights.
double light_tree_host_bytes(size_t count);

/// The tables' content.
struct LightTreeContent {
    std::vector<LightRecord> lights;
    std::vector<LightAreaRecord> areas;
    std::vector<LightNode> nodes;
};

/// The tree of points and spots, or of lights with an area, at least one. Each node's lights are
/// divided into two halves by their positions along the axis on which these are farthest apart. The
/// result is equal on every machine.
LightTreeContent light_tree_of(std::span<const PathLight> lights, const GridFrame& world);

/// The kernel of light_tree.cl for one feature set, and the trees of a scene.
class LightTreeStage {
  public:
    LightTreeStage(const Device& device, const Features& features,
                   const Buffer<MaterialRecord>& materials,
                   std::span<const std::vector<PathLight>> lists, const GridFrame& world);

    /// Adds the light of the lights of a tree that the surface points 0 .. count-1 of paths choose,
    /// as LightStage adds that of one light.
    void add(const Pyramid& pyramid, const LightTree& tree, const PathSampling& sampling,
             RayBatch& batch, uint32_t count, ShadowQueue& queue);

    /// One for each list.
    const std::vector<LightTree>& trees() const { return trees_; }

  private:
    Buffer<MaterialRecord> materials_;
    std::vector<LightTree> trees_;
    Program program_;
    Kernel add_;
};

}  // namespace voxelume
