// SPDX-License-Identifier: Apache-2.0
// The code that uses OpenVDB is a module, libvoxelume_vdb.so. The program opens it when it first
// reads or writes a .vdb, because OpenVDB's 64,000 relocations would cost each start of the program
// 45 ms.
#pragma once

#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/vdb/vdb_density.hpp"
#include "runtime/io/vdb/vdb_voxels.hpp"
#include "runtime/io/volume/volume_formats.hpp"

namespace voxelume {

/// The functions of this folder's headers, as namespace vdb defines them in the module.
struct VdbFunctions {
    const char* version;  ///< version of the program that the module belongs to
    decltype(voxelume::isolate_vdb_readers)* isolate_vdb_readers;
    decltype(voxelume::write_vdb)* write_vdb;
    decltype(voxelume::read_vdb_summary)* read_vdb_summary;
    decltype(voxelume::is_vdb_as_written)* is_vdb_as_written;
    decltype(voxelume::read_vdb_density)* read_vdb_density;
    decltype(voxelume::read_vdb_voxels)* read_vdb_voxels;
    decltype(voxelume::write_volume_vdb)* write_volume_vdb;
    decltype(voxelume::read_volume_vdb)* read_volume_vdb;
};

/// The table in the module; the program finds it by its name.
extern "C" const VdbFunctions voxelume_vdb_functions;

}  // namespace voxelume
