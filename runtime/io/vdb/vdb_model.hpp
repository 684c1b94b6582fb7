// SPDX-License-Identifier: Apache-2.0
// The voxels of a model on their way from the helper program, with their grid for surfaces that
// store distances.
#pragma once

#include "runtime/base/helper/helper_wire.hpp"
#include "runtime/io/vdb/vdb_read.hpp"

namespace voxelume::vdb {

void send_model(WireSender& sender, const VdbModel& model, Surface surface);

/// Throws HelperFailure for what no model of this surface has, and for a grid that takes more than
/// `max_bytes`.
VdbModel receive_model(WireReceiver& receiver, Surface surface, uint64_t max_bytes);

}  // namespace voxelume::vdb
