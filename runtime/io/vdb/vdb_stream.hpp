// SPDX-License-Identifier: Apache-2.0
// OpenVDB's grids -> an AtomicFile. Only the sources of this folder include this header, because
// OpenVDB's headers take long to compile.
#pragma once

#include <openvdb/openvdb.h>

#include <filesystem>
#include <optional>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/input_file.hpp"

namespace voxelume::vdb {

/// Writes grids through a stream of ours, because OpenVDB's own file class reports success on a
/// full disk. An identifier from the content replaces OpenVDB's random one, so equal grids give
/// equal bytes. Throws Error::output; the caller commits.
void write_vdb_grids(AtomicFile& file, const openvdb::GridCPtrVec& grids,
                     const openvdb::MetaMap& metadata);

/// True if the file's identifier is the one that write_vdb_grids gives its content, so that the
/// file is unchanged since then. Call this before OpenVDB reads the file in this process: damaged
/// files corrupt the process's memory.
bool vdb_identifier_holds(const InputFile& file);

std::optional<bool> is_vdb_as_written(const std::filesystem::path& path);

}  // namespace voxelume::vdb
