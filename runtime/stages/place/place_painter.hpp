// SPDX-License-Identifier: Apache-2.0
// An object that is placed in the world: its inverse map, and the kernels that paint its voxels.
#pragma once

#include <functional>
#include <map>
#include <set>
#include <utility>

#include "runtime/opencl/program.hpp"
#include "runtime/stages/place/place.hpp"
#include "runtime/stages/place/placement_attributes.hpp"
#include "runtime/stages/place/placement_map.hpp"

namespace voxelume {

Surface surface_of(const BrickGrid& grid);

/// The parts that the world stores: those that some object has.
struct WorldParts {
    bool smooth = false, occupancy = false, colors = false, normals = false, transparent = false,
         cubes = false;
    std::set<uint32_t> attributes;  ///< all values that voxels can have

    bool has_attributes() const { return attributes.size() > 1; }
    /// True if bricks of both worlds have the same buffers.
    bool is_stored_like(const WorldParts& other) const;
};

WorldParts parts_of(std::span<const PlacedObject> objects);

/// WorldBounds of lib/traverse/world_bounds.h.
struct WorldBounds {
    glm::ivec4 size, half_voxel;
};

WorldBounds bounds_of(const GridFrame& frame);

/// A box of the world's bricks.
struct BrickBox {
    glm::ivec3 first{0}, last{-1};

    bool is_empty() const { return first.x > last.x || first.y > last.y || first.z > last.z; }
};

/// The world's bricks that contain the object's grid and a margin around it.
BrickBox bricks_of(const PlacedObject& object, const GridFrame& world);

/// The bricks of the world that are to be painted, on the device.
struct PaintedBricks {
    uint32_t count = 0;
    Buffer<uint32_t> slots;
};

/// A world and those of its bricks that are to be painted.
struct PaintedWorld {
    const PaintedBricks& painted;
    const BrickGrid& world;
};

/// VXL_PAINTED_PARAMETERS of kernels.
void bind(KernelArguments& to, const PaintedWorld& painted);

/// The near leaves of objects' grids; objects with the same grid share them.
class NearLeaves {
  public:
    /// Per slot: a mask of the leaves with voxels, or with distances below `threshold`. `mark`
    /// makes the masks unless the grid had them in this list of objects or the last one.
    Buffer<uint64_t> of(const BrickGrid& grid, int threshold,
                        const std::function<Buffer<uint64_t>()>& mark);

    /// Begins the next list of objects, and forgets masks that the last list didn't use.
    void begin_list();

  private:
    struct Entry {
        Buffer<uint64_t> masks;
        bool is_used = true;
    };
    std::map<std::pair<const BrickGrid*, int>, Entry> entries_;
};

/// An object ready to be painted into a world. Its grid must outlive it.
class Painter {
  public:
    Painter(const Device& device, const PlacedObject& object, const GridFrame& world,
            const WorldParts& parts, NearLeaves& near);

    const PlacedObject& object() const { return object_; }
    Surface surface() const { return surface_; }

    /// The bricks of the world that may contain voxels of the object.
    const BrickBox& bricks() const { return bricks_; }

    /// Raises the states of `count` bricks of the world: the first `count` of `listed`, or all
    /// bricks if `listed` is empty.
    void classify(const GridFrame& world, uint32_t count, const Buffer<uint32_t>& listed,
                  const Buffer<uint8_t>& states);

    /// Adapts the painter to a world that stores different parts.
    void follow(const Device& device, const WorldParts& parts);

    void paint(const PaintedBricks& painted, BrickGrid& world);

    /// Closes the world's distances at its bounds. One call of any smooth object's painter closes
    /// all.
    void close_distances(const PaintedBricks& painted, BrickGrid& world);

    /// VXL_OBJECT_PARAMETERS of kernels.
    friend void bind(KernelArguments& to, const Painter& painter);

  private:
    void paint_smooth(const PaintedBricks& painted, BrickGrid& world);
    void paint_cubes(const PaintedBricks& painted, BrickGrid& world);

    PlacedObject object_;
    Surface surface_;
    PlacementMap map_;
    BrickBox bricks_;
    Buffer<int64_t> rows_;
    Program program_;
    AttributeMap attribute_map_;
    int threshold_;  ///< leaves with a smaller distance are near
    Buffer<uint64_t> near_;
};

}  // namespace voxelume
