// SPDX-License-Identifier: Apache-2.0
// Helpers for the JSON headers next to raw arrays.
#pragma once

#include <nlohmann/json.hpp>

#include "runtime/io/volume/volume_formats.hpp"

namespace voxelume {

using VolumeJson = nlohmann::ordered_json;

/// The path of the header: `volume.raw` -> `volume.json`; any other data file gets `.json`
/// appended.
VolumePath header_path_of(const VolumePath& data);

/// The header in a file; null where there is none of this format.
VolumeJson read_header(const VolumePath& header, VolumeFormat format);

/// Throws Error::output where the header would replace a file that is no header of this format: a
/// scene, or the header of other files with the same name.
void check_header(const VolumePath& header, VolumeFormat format);

/// Returns a header with magic, format, data file, byte order, layout, frame and attributes.
VolumeJson start_header(const VolumePath& data, const Volume& volume, VolumeFormat format);

/// Writes the text under its name whole or not at all.
void write_json(const VolumePath& path, const VolumeJson& json);

}  // namespace voxelume
