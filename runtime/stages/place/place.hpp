// SPDX-License-Identifier: Apache-2.0
// object grids -> S: the world as the list of its objects defines it.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/parts/surface.hpp"

namespace voxelume {

/// The maximum ratio of an edge of the world's voxels to an edge of a distance field's voxels.
inline constexpr double kFinestField = 1.42;

/// An object's voxels and its placement in the world.
struct PlacedObject {
    const BrickGrid* grid = nullptr;    ///< in the object's own frame; not owned
    glm::dmat4 world_from_object{1.0};  ///< metres to metres; it may mirror and shear
    uint32_t object = 0;  ///< the object's number in the scene, at most 65535; of several with one
                          ///< number all but one are exact
    int priority = 0;     ///< where objects overlap, the larger priority wins
    std::vector<uint32_t> material_of_group =
        {};  ///< for each of the grid's groups; the last material serves all further groups; if
             ///< empty, the group's number is the material
    VoxelSet set = VoxelSet::supercover;  ///< the kind of set that its cubes are; `thin` widens
                                          ///< turned sheets
    bool in_world_frame = false;  ///< true if `grid` has the world's frame already; the map is not
                                  ///< used then
    bool keeps_inside = false;    ///< for solid cubes: true if rays see the voxels inside, too

    friend bool operator==(const PlacedObject&, const PlacedObject&) = default;
};

/// Resamples every object into one grid of the world by the inverse of its map. Each object is
/// resampled in one step from its own voxels, so nothing drifts and no holes open.
///
/// Cubes: a world voxel is set if its centre's image lies in a set voxel of the object, or if a set
/// voxel touches the box around that image that extends by r = max(0, (max_j |A_aj| - 1) / 2) along
/// each object axis a. A is the map of world voxels to object voxels. This keeps a SUPERCOVER shell
/// or a SOLID tight against paths of voxels that share faces: two voxels that such a set separates
/// differ by at least 2 in some index, the boxes of face neighbours come within one voxel of each
/// other along every axis, and a box without set voxels lies on one side. At equal or finer world
/// voxels r is 0, and shrunk objects are covered block by block. A THIN set needs r = max_j |A_aj|
/// / 2, so its turned sheets get up to two voxels thick.
///
/// Smooth: a world node gets the object's half-Taylor distance there, times the map's smallest
/// stretch, so an unevenly stretched field has the right surface and never overestimates. The
/// distance is right within 2.8 world voxels of the surface as far as the object's own band
/// extends. In cells at the band's end it is extrapolated linearly; farther out it is saturated
/// with the right sign. World voxels that are q times as large as the object's need a band of 2.8 q
/// object voxels for full accuracy: with 2.8 and q <= kFinestField, cells keep their corners but
/// some lose second differences. Beyond that the band ends inside of world voxels and the surface
/// would be wrong by up to a voxel, so such a field is refused. In the world's own lattice, or in a
/// part of it with the identity as map, the distances are copied. Several objects are united: the
/// smallest distance counts.
///
/// Exact objects must be in the world's frame. Their lists are joined per voxel, in the order of
/// `objects`.
///
/// Overlaps: a voxel shows the object with the larger priority; if two have equal priorities, it
/// shows the one earlier in `objects`. Among smooth surfaces it shows the one nearest to its
/// centre, and ties follow the rule above. A smooth object that wins takes the voxels its surface
/// passes through away from cubes. An exact and a smooth surface share a voxel: the voxel is exact
/// and has the smooth surface's packed attributes, since primitives have their own. Between an
/// exact surface and a cube the cube wins. The result does not depend on the order of work. Solids
/// end at the world's bounds, and the cut is surface.
///
/// `attributes` are stored only if the objects together have more than one value of them. A world
/// whose only object is in its frame shares that object's buffers. Bricks are stored wherever an
/// object may have surface. A brick is kBrickInside only if the voxels around it are full, too, and
/// belong to an object that doesn't keep its inside.
///
/// Throws Error::scene for a placement that can't be inverted and for a field that is too fine,
/// Error::limit if memory doesn't suffice.
BrickGrid place(const Device& device, std::span<const PlacedObject> objects,
                const GridFrame& world);

class NearLeaves;

/// Places one list of objects after another. It repaints only those bricks of the world that a
/// changed object covered or covers now. The voxels equal those of `place`.
class Placer {
  public:
    /// Placers of objects with the same grids may share their near leaves.
    explicit Placer(const Device& device, std::shared_ptr<NearLeaves> near = {});
    ~Placer();
    Placer(const Placer&) = delete;
    Placer& operator=(const Placer&) = delete;

    /// Places `objects`, whose grids must live until the next call has returned or the placer is
    /// destroyed. The next call changes the result; its slots are in no order. Throws as `place`
    /// does; the call after an exception begins with an empty world.
    const BrickGrid& place(std::span<const PlacedObject> objects, const GridFrame& world);

    /// The number of bricks that the last call painted; 0 if the world shares its only object's
    /// buffers.
    uint32_t painted_bricks() const;

    /// The indices of all bricks that differ from those before the last call, and possibly of
    /// others; null if the last call began with an empty world.
    const std::vector<uint32_t>* changed_bricks() const;

  private:
    class State;
    Device device_;
    const bool owns_near_;
    std::shared_ptr<NearLeaves> near_;
    std::unique_ptr<State> state_;
};

}  // namespace voxelume
