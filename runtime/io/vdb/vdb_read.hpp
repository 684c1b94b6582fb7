// SPDX-License-Identifier: Apache-2.0
// An OpenVDB file of any origin -> its grids. Only the sources of this folder include this header,
// because OpenVDB's headers take long to compile.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>

#include "runtime/base/input_file.hpp"

namespace voxelume::vdb {

/// Sets whether read_vdb_grids has a child process read files first.
void isolate_vdb_readers(bool is_isolated);

/// Reads all grids. Damaged files make OpenVDB corrupt memory, so a child process first reads every
/// file that doesn't have the identifier that voxelume gives its content, unless isolation is off.
///
/// Throws Error::input for a file that is damaged, truncated or too large for the memory.
openvdb::GridPtrVecPtr read_vdb_grids(const std::filesystem::path& path, const InputFile& readable);

}  // namespace voxelume::vdb
