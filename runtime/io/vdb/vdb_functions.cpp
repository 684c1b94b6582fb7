// SPDX-License-Identifier: Apache-2.0
// The table of functions that the program takes from the module.
#include "runtime/io/vdb/vdb_module.hpp"

namespace voxelume {

// Namespace vdb keeps these apart from the program's functions of equal names, which call them.
namespace vdb {

decltype(voxelume::isolate_vdb_readers) isolate_vdb_readers;
decltype(voxelume::write_vdb) write_vdb;
decltype(voxelume::read_vdb_summary) read_vdb_summary;
decltype(voxelume::is_vdb_as_written) is_vdb_as_written;
decltype(voxelume::read_vdb_density) read_vdb_density;
decltype(voxelume::read_vdb_voxels) read_vdb_voxels;
decltype(voxelume::write_volume_vdb) write_volume_vdb;
decltype(voxelume::read_volume_vdb) read_volume_vdb;

}  // namespace vdb

const VdbFunctions voxelume_vdb_functions = {
    VXL_VERSION,           vdb::isolate_vdb_readers, vdb::write_vdb,
    vdb::read_vdb_summary, vdb::is_vdb_as_written,   vdb::read_vdb_density,
    vdb::read_vdb_voxels,  vdb::write_volume_vdb,    vdb::read_volume_vdb};

}  // namespace voxelume
