// BrickGrid <-> bytes that are small and quick to read, for the model cache.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// A header, then each buffer; nothing, where that is more than `max_bytes`. Waits for the
/// device's queue.
std::optional<std::string> bytes_of_grid(const BrickGrid& grid, uint64_t max_bytes);

/// The grid on a device; nothing for bytes that are no whole grid. Throws Error::limit when the
/// device has not enough memory.
std::optional<BrickGrid> grid_of_bytes(const Device& device, std::string_view bytes);

/// Bytes of the grid's buffers on the device.
uint64_t device_bytes(const BrickGrid& grid);

}  // namespace voxelume
