// What is in a mesh file, and how many voxels it would become.
#pragma once

#include <filesystem>

#include "cli/report.hpp"

namespace voxelume::cli {

Report describe_mesh(const std::filesystem::path& path);

}  // namespace voxelume::cli
