// SPDX-License-Identifier: Apache-2.0
// The memory that a pyramid takes on a device, and its bytes for the disk.
#pragma once

#include <optional>
#include <string>
#include <string_view>

#include "runtime/grid/grid.hpp"

namespace voxelume {

/// The bytes of all of a pyramid's buffers, including its instances'.
uint64_t bytes_of(const Pyramid& pyramid);

/// The bytes of the voxels of a pyramid without instances, few and quick to read. Waits for the
/// device's queue.
std::string bytes_of_pyramid(const Pyramid& pyramid);

/// The pyramid of these bytes on a device; empty if the bytes are no pyramid. Throws Error::limit
/// if the device's memory doesn't suffice.
std::optional<Pyramid> pyramid_of_bytes(const Device& device, std::string_view bytes);

}  // namespace voxelume
