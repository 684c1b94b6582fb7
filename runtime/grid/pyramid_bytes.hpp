// What a pyramid takes of a device's memory, and its bytes for the disk.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// Bytes of all of a pyramid's buffers, its instances' included.
uint64_t bytes_of(const Pyramid& pyramid);

/// The voxels of a pyramid without instances, small and quick to read. Waits for the device's
/// queue.
std::string bytes_of_pyramid(const Pyramid& pyramid);

/// That pyramid on a device; nothing for bytes that are none. Throws Error::limit when the device
/// has not enough memory.
std::optional<Pyramid> pyramid_of_bytes(const Device& device, std::string_view bytes);

}  // namespace voxelume
