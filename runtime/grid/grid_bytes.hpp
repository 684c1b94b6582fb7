// SPDX-License-Identifier: Apache-2.0
// BrickGrid <-> bytes that are few and quick to read, for the model cache.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The bytes of a header and of each buffer; empty if they are more than `max_bytes`. Waits for the
/// device's queue.
std::optional<std::string> bytes_of_grid(const BrickGrid& grid, uint64_t max_bytes);

/// The grid of these bytes on a device; empty if the bytes are no complete grid. Throws
/// Error::limit if the device's memory doesn't suffice.
std::optional<BrickGrid> grid_of_bytes(const Device& device, std::string_view bytes);

/// The bytes of the grid's buffers on the device.
uint64_t device_bytes(const BrickGrid& grid);

}  // namespace voxelume
