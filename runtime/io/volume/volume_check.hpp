// SPDX-License-Identifier: Apache-2.0
// Whether the data of a volumetric image are those that the JSON header beside them tells of.
#pragma once

#include <optional>

#include "runtime/io/volume/volume_formats.hpp"

namespace voxelume {

/// True if raw data or those of a display's own format match their header's hashes, and the header
/// its stamp if it has one. `path` is that of the data or of the header; empty if there is no such
/// header. Throws Error::input where the data can't be read.
std::optional<bool> is_volume_data_as_written(const VolumePath& path);

}  // namespace voxelume
