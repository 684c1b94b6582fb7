// SPDX-License-Identifier: Apache-2.0
// PlacedWorld -> Pyramid: fields of several objects, and cubes and exact voxels among them.
#pragma once

#include <map>

#include "runtime/grid/placed_world.hpp"
#include "runtime/stages/index/index_marks.hpp"

namespace voxelume {

/// Builds the pyramids of successive worlds with fields, and looks for the voxels of a field only
/// if it is new.
///
/// A voxel that one object's surface may cross is smooth, and has that object's record. A voxel
/// that several surfaces may cross lists their records. An exact voxel also lists the records of
/// fields whose surfaces may cross it. Rays meet the nearest of all surfaces in a voxel. Between
/// cubes and fields in one voxel, priority decides.
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
