// OpenVDB's grids into a file of ours. Only the sources beside it include this: OpenVDB's headers
// take long to compile.
#pragma once

#include <openvdb/openvdb.h>

#include "runtime/base/atomic_file.hpp"
#include "runtime/base/input_file.hpp"

namespace voxelume::vdb {

/// Writes through a stream of ours: OpenVDB's own file reports success on a full disk. Its random
/// identifier is replaced by one from the content, so the same grids give the same bytes. Throws
/// Error::output; the caller commits.
void write_vdb_grids(AtomicFile& file, const openvdb::GridCPtrVec& grids,
                     const openvdb::MetaMap& metadata);

/// The identifier is the one that write_vdb_grids gives this content: nothing has changed since.
/// To be asked before OpenVDB reads a file in earnest, as damaged ones corrupt its memory.
bool vdb_identifier_holds(const InputFile& file);

}  // namespace voxelume::vdb
