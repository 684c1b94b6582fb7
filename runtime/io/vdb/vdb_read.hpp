// An OpenVDB file of any origin -> its grids. Only the sources beside it include this: OpenVDB's
// headers take long to compile.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>

#include "runtime/base/input_file.hpp"

namespace voxelume::vdb {

/// Reads all grids. Damaged files make OpenVDB corrupt memory, so one that doesn't have the
/// identifier that voxelume gave it is read by a child process first.
///
/// Throws Error::input for a file that is damaged, truncated or too large for the memory.
openvdb::GridPtrVecPtr read_vdb_grids(const std::filesystem::path& path, const InputFile& readable);

}  // namespace voxelume::vdb
