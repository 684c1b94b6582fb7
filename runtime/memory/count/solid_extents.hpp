// SPDX-License-Identifier: Apache-2.0
// What solids take of lattices in their own spaces, for all frames of a scene.
#pragma once

#include <functional>
#include <vector>

#include "runtime/geometry/surface_extent.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Extents of solids in their models' own spaces, which frames share.
class SolidExtents {
  public:
    /// The extent that was kept for a model and voxels of this edge, or what `count` finds.
    SurfaceExtent of(const Model& model, double edge, const std::function<SurfaceExtent()>& count);

  private:
    struct Known {
        Model model;
        double edge;
        SurfaceExtent extent;
    };
    std::vector<Known> known_;
};

}  // namespace voxelume
