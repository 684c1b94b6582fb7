// SPDX-License-Identifier: Apache-2.0
// PlacedWorld -> Pyramid: fields of several objects, and cubes and exact voxels among them.
#pragma once

#include <map>

#include "runtime/grid/placed_world.hpp"
#include "runtime/stages/index/index_marks.hpp"

namespace voxelume {

/// Builds the pyramids of worlds with fields, one after another, and looks for the voxels of a
/// field only where that is new.
///
/// A voxel that one object's surface may cross is smooth, and has that object's record. A voxel
/// that several may cross lists their records, and an exact voxel those of the surfaces that may
/// cross it; rays meet the nearest of all its surfaces. Between cubes and fields in one voxel the
/// order of priorities decides.
class FieldIndexer {
  public:
    explicit FieldIndexer(const Device& device) : device_(device) {}

    /// `world` has fields. Throws Error::limit if the device's memory doesn't suffice, or for more
    /// than 2^28 voxels and listed fields.
    Pyramid index(const PlacedWorld& world);

  private:
    void mark(const PlacedWorld& world);

    Device device_;
    std::map<uint64_t, VoxelMarks> marks_;  ///< by the fields' versions
};

}  // namespace voxelume
