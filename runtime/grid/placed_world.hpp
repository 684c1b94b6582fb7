// SPDX-License-Identifier: Apache-2.0
// A world's objects in its lattice, before they are indexed.
#pragma once

#include <cstdint>
#include <vector>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The distance field of one smooth object, or of a part of it, in a part of the world's lattice
/// that holds the object.
struct PlacedField {
    BrickGrid grid;             ///< packed attributes are the world's
    glm::ivec3 first_brick{0};  ///< minimum brick of this part, in the world's bricks
    uint32_t object = 0;        ///< the object's number in the scene
    FieldPlace place;           ///< place of this part among those of the object
    bool is_first = true;       ///< false if the field before it belongs to the same object
    uint64_t version = 0;       ///< differs between any two fields that aren't the same
};

/// The input of `index`.
struct PlacedWorld {
    BrickGrid voxels;                 ///< voxels of all objects but those of `fields`
    std::vector<PlacedField> fields;  ///< fields of several objects never merge; the first in the
                                      ///< order of priorities comes first
    std::vector<uint32_t> ranks;      ///< the rank of each object by priority, by objects' numbers
};

}  // namespace voxelume
