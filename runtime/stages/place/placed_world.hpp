// SPDX-License-Identifier: Apache-2.0
// object grids -> a placed world: each smooth object's field separately, the rest in one grid.
#pragma once

#include <map>
#include <memory>
#include <optional>

#include "runtime/grid/placed_world.hpp"
#include "runtime/stages/place/place.hpp"

namespace voxelume {

/// Places successive lists of objects of any kinds.
///
/// Cubes and exact objects are placed as `place` does. Where there are several objects, or parts of
/// one, each smooth one gets a grid of its own, in the part of the world's lattice around it, so
/// that the fields of objects that touch don't merge.
class WorldPlacer {
  public:
    explicit WorldPlacer(const Device& device);

    /// Places `objects`, whose grids must live until the next call has returned or the placer is
    /// destroyed. The next call changes the result. Throws as `place` does.
    const PlacedWorld& place(std::span<const PlacedObject> objects, const GridFrame& world);

    /// The number of bricks that the last call painted, without those that share their object's
    /// buffers.
    uint32_t painted_bricks() const { return painted_; }

    /// The indices of all bricks that may differ from those before the last call; null if that is
    /// unknown. With fields it is empty or null.
    const std::vector<uint32_t>* changed_bricks() const { return changed_ ? &*changed_ : nullptr; }

  private:
    struct Kept {
        PlacedObject object;
        std::vector<PlacedField> fields;  ///< its parts'; empty for an object outside of the world
    };

    void place_voxels(std::span<const PlacedObject> objects, const GridFrame& world);
    std::optional<PlacedField> place_field(const PlacedObject& object, const GridFrame& world);
    std::vector<PlacedField> place_fields(const PlacedObject& object, const GridFrame& world);

    Device device_;
    std::shared_ptr<NearLeaves> near_;
    Placer voxels_;
    GridFrame frame_;
    std::map<uint32_t, Kept> fields_;  ///< by objects' numbers
    PlacedWorld world_;
    std::optional<std::vector<uint32_t>> changed_;
    uint32_t painted_ = 0;
    uint64_t versions_ = 0;
};

/// One list of objects, placed.
PlacedWorld place_world(const Device& device, std::span<const PlacedObject> objects,
                        const GridFrame& world);

}  // namespace voxelume
