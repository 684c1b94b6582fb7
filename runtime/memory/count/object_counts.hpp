// SPDX-License-Identifier: Apache-2.0
// scene -> the expected or minimum numbers of bricks and voxels in its grids and its world.
#pragma once

#include <map>
#include <optional>
#include <vector>

#include "runtime/analysis/object_lattice.hpp"
#include "runtime/memory/count/brick_count.hpp"
#include "runtime/memory/count/count_grids.hpp"
#include "runtime/memory/count/count_world.hpp"
#include "runtime/memory/count/plan_extent.hpp"
#include "runtime/memory/count/plan_object.hpp"
#include "runtime/memory/count/solid_extents.hpp"

namespace voxelume {

enum class Estimate : uint8_t {
    expected,  ///< with a margin for what areas and distances of surfaces don't tell
    minimum    ///< lower bounds
};

/// Counts for one scene; counts that objects share are made once. Reads what ObjectExtents does.
class ObjectCounts {
  public:
    ObjectCounts(const Scene& scene, AssetStore& meshes, SolidExtents& solids)
        : scene_(scene),
          meshes_(meshes),
          extents_(scene, meshes),
          lattices_(scene, meshes),
          of_solids_(solids) {}

    /// The grid of a model in its own space, and of an object in the world's lattice or a part of
    /// it.
    GridCounts model_grid(const Model& model, const GridFrame& frame, Estimate estimate);
    GridCounts object_grid(const Object& object, const Model& model, const GridFrame& frame,
                           Estimate estimate);

    /// The voxels of the world's objects.
    WorldCounts world(Estimate estimate);

    /// The bricks that are expected for the objects for which `objects` is true.
    PartBricks changed_bricks(const std::vector<bool>& objects);

    /// The boxes that object_boxes() gives.
    const std::vector<VoxelBox>& boxes() { return extents_.boxes(); }

  private:
    const VoxelBox& box_of(const Object& object) {
        return boxes()[size_t(&object - scene_.objects.data())];
    }
    /// The numbers of the objects in the world's voxels; those of smooth objects come last.
    std::vector<size_t> placed_numbers();
    bool is_smooth(size_t number) const;
    WorldCounts expected_world();
    WorldCounts min_world();
    SurfaceExtent solid_extent(const Model& model, const GridFrame& frame);
    SurfaceExtent object_extent(const Object& object, const GridFrame& frame);
    BrickCount expected_in_world(const Object& object, TakenBricks& taken);
    WorldExtent min_in_world(size_t number);
    SurfaceExtent min_of_voxels(const Object& object, const VoxelModel& voxels);

    const Scene& scene_;
    AssetStore& meshes_;
    ObjectExtents extents_;
    ObjectLattices lattices_;
    SolidExtents& of_solids_;
    std::map<const Object*, SurfaceExtent> of_objects_;  ///< solids' extents in the world
    std::optional<WorldCounts> expected_;                ///< counts of the world
    std::vector<SurfaceExtent> in_world_;  ///< extents in the world, one for each object
};

/// The grid of a mesh whose surface has this area.
GridCounts mesh_grid(const Model& model, const MeshSummary& mesh, const GridFrame& frame,
                     const SurfaceArea& area);

}  // namespace voxelume
