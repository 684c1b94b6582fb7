// What is in the file of a volumetric image.
#pragma once

#include <filesystem>

#include "cli/report.hpp"

namespace voxelume::cli {

/// A deep OpenEXR, OpenVDB, NRRD or JSON header of voxelume. `kind` opens the report.
Report describe_volume(const std::filesystem::path& path, const char* kind);

/// The JSON header beside a raw or a display's own file.
Report describe_volume_header(const std::filesystem::path& path);

/// The header of a KV6 model.
Report describe_kv6(const std::filesystem::path& path);

}  // namespace voxelume::cli
