// SPDX-License-Identifier: Apache-2.0
// What is in a file, as JSON values: one function a kind of file.
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>

namespace voxelume::api {

using Report = nlohmann::ordered_json;

/// What is in a mesh file, and how many voxels it would become.
Report describe_mesh(const std::filesystem::path& path);

/// A deep OpenEXR, OpenVDB, NRRD or JSON header of voxelume. `kind` opens the report.
Report describe_volume(const std::filesystem::path& path, const char* kind);

/// The JSON header that accompanies a raw file or a display's own.
Report describe_volume_header(const std::filesystem::path& path);

/// The header of a KV6 model.
Report describe_kv6(const std::filesystem::path& path);

/// Models, objects, materials and palette of a MagicaVoxel file, and what of it isn't shown.
Report describe_vox(const std::filesystem::path& path);

}  // namespace voxelume::api
