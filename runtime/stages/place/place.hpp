// object grids -> S: the world as the list of its objects defines it.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <memory>
#include <span>
#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene/surface.hpp"

namespace voxelume {

/// An object's voxels and where they stand in the world.
struct PlacedObject {
    const BrickGrid* grid = nullptr;    ///< in its own frame; not owned
    glm::dmat4 world_from_object{1.0};  ///< metres to metres; mirrors and shears are welcome
    uint32_t object = 0;                ///< its number in the scene, its own, at most 65535
    int priority = 0;                   ///< the larger wins where objects overlap
    std::vector<uint32_t> material_of_group =
        {};                               ///< of the grid's groups; the last serves all further
                                          ///< groups; empty: the group is the material
    VoxelSet set = VoxelSet::supercover;  ///< what its cubes are; `thin` widens turned sheets
    bool in_world_frame = false;  ///< `grid` has the world's frame already, the map is not used
    bool keeps_inside = false;    ///< of solid cubes: rays see the voxels inside, too

    friend bool operator==(const PlacedObject&, const PlacedObject&) = default;
};

/// Resamples every object into one grid of the world by the inverse of its map, in one step from
/// its own voxels, so nothing drifts and no holes open.
///
/// Cubes. A world voxel is set when its centre's image lies in a set voxel of the object, or a set
/// voxel touches the box around the image that reaches r = max(0, (max_j |A_aj| - 1) / 2) along
/// each object axis a, A being the map of world voxels to object voxels. That keeps a SUPERCOVER
/// shell or a SOLID tight against paths of voxels that share faces: two voxels that such a set
/// separates differ by at least 2 in some index, the boxes of face neighbours come within one
/// voxel of each other along every axis, and a box without set voxels lies on one side. At equal
/// or finer world voxels r is 0, and shrunk objects are covered block by block. A THIN set needs
/// r = max_j |A_aj| / 2, so turned sheets of it get up to two voxels thick.
///
/// Smooth. A world node gets the object's half-Taylor distance there, times the map's smallest
/// stretch, so an unevenly stretched field has the right surface and never overestimates. It is
/// right within 2.8 world voxels of the surface as far as the object's own band reaches; in cells
/// at the band's end the distance is extrapolated linearly, beyond it is saturated with the right
/// sign. World voxels that are q times as large as the object's, q <= 1.4, need a band of 2.8 q
/// object voxels for full accuracy: with 2.8, cells keep their corners but some lose second
/// differences. From q = 2 on the surface is right to about a voxel only: such objects should be
/// voxelized more coarsely. Several objects are united: the smallest distance counts.
///
/// Exact objects must be in the world's frame. Their lists are joined per voxel, in the order of
/// `objects`.
///
/// Overlaps: a voxel shows the object with the larger priority, and of equals the one earlier in
/// `objects`; between smooth surfaces the one nearest to the voxel's centre, ties by that rule. A
/// smooth object that wins takes the voxels its surface passes through away from cubes. An exact
/// and a smooth surface share a voxel: it is exact, with the smooth surface's word, for primitives
/// have their own; of an exact and a cube the cube wins. The result does not depend on the order
/// of work. Solids end at the world's bounds, and the cut is surface.
///
/// `attributes` are stored only when the objects have more than one word together. A world whose
/// only object is in its frame shares that object's buffers. Bricks are stored wherever an object
/// may have surface, and a brick is kBrickInside only if the voxels around it are full, too, and of
/// an object that doesn't keep its inside.
///
/// Throws Error::scene for a placement that can't be inverted, Error::limit for too little memory.
BrickGrid place(const Device& device, std::span<const PlacedObject> objects,
                const GridFrame& world);

/// Places one list of objects after another, and paints again only the bricks of the world that
/// the objects which changed had a part in, or have now. The voxels are those that `place` gives.
class Placer {
  public:
    explicit Placer(const Device& device);
    ~Placer();
    Placer(const Placer&) = delete;
    Placer& operator=(const Placer&) = delete;

    /// The grids of `objects` must live until the next call has returned, or the placer has gone.
    /// The result is changed by the next call; its slots are in no order. Throws as `place` does,
    /// and starts afresh then.
    const BrickGrid& place(std::span<const PlacedObject> objects, const GridFrame& world);

    /// Bricks that the last call painted: none where the world is its only object.
    uint32_t painted_bricks() const;

    /// The places of all bricks that differ from those before the last call, and perhaps some that
    /// don't; null where the world was begun afresh.
    const std::vector<uint32_t>* changed_bricks() const;

  private:
    class State;
    Device device_;
    std::unique_ptr<State> state_;
};

}  // namespace voxelume
