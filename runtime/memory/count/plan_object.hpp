// SPDX-License-Identifier: Apache-2.0
// object -> the extent of its surface in the world, expected and minimum.
#pragma once

#include <map>
#include <vector>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/assets/asset_store.hpp"
#include "runtime/geometry/surface_extent.hpp"

namespace voxelume {

/// The extents of a scene's objects in its world; extents that objects share are found once. Reads
/// the meshes of the objects that it is asked for, as AssetStore does.
class ObjectExtents {
  public:
    ObjectExtents(const Scene& scene, AssetStore& meshes);

    /// The area of a model's surface in its own space.
    const SurfaceArea& area_of(int model_number);

    SurfaceExtent planned(const Object& object, double band) { return extent(object, band, false); }

    /// The minimum extent of an object; 0 for a mesh that is cut.
    SurfaceExtent minimum(const Object& object, double band);

    /// The extent of the exact parts of a smooth mesh; 0 where it has none.
    SurfaceExtent thin_part(const Object& object, double band);

    /// The world's voxels in an object whose inside rays see: at most those of its box.
    double inside_voxels(const Object& object);

    /// True if the map takes all of a box into the world.
    bool lies_in_world(const glm::dvec3& low, const glm::dvec3& high, const glm::dmat4& map) const;

    /// The objects' boxes as object_boxes() gives them.
    const std::vector<VoxelBox>& boxes();

  private:
    SurfaceExtent extent(const Object& object, double band, bool is_minimum);
    double part_in_world(const Object& object);

    const Scene& scene_;
    AssetStore& meshes_;
    GridFrame frame_;
    SolidBounds box_;  ///< the world's
    std::map<int, SurfaceArea> areas_;
    std::map<const Object*, double> parts_;  ///< parts of meshes in the world
    std::vector<VoxelBox> boxes_;            ///< empty until it is first asked for
};

/// The minimum area of a mesh's surface in its own space, without its thin parts where the field is
/// left out.
SurfaceArea min_area_of(const Model& model, AssetStore& meshes);

/// The ratio of the box around a cube in the object's space to the cube, on average over its axes.
double spread_of(const Object& object);

}  // namespace voxelume
