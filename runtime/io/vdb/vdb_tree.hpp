// SPDX-License-Identifier: Apache-2.0
// A float grid on its way from the helper program: background, tiles, leaves and an affine
// transform as plain numbers. The receiver builds a grid of its own of them, with the same values
// everywhere.
#pragma once

#include <openvdb/openvdb.h>

#include "runtime/base/helper/helper_wire.hpp"

namespace voxelume::vdb {

void send_grid(WireSender& sender, const openvdb::FloatGrid& grid);

/// Throws HelperFailure for numbers that no grid has, values that aren't finite among them, and for
/// a tree that takes more than `max_bytes`.
openvdb::FloatGrid::Ptr receive_grid(WireReceiver& receiver, uint64_t max_bytes);

}  // namespace voxelume::vdb
