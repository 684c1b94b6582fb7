// SPDX-License-Identifier: Apache-2.0
// An OpenVDB file of any origin -> its contents, read in this process although damaged files make
// OpenVDB corrupt its memory; vdb_client.cpp has another process call these functions. Only the
// sources of this folder include this header, because OpenVDB's headers take long to compile.
#pragma once

#include <openvdb/openvdb.h>

#include <memory>
#include <string>

#include "runtime/base/files/input_file.hpp"
#include "runtime/image/volume.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/vdb/vdb_density.hpp"
#include "runtime/io/vdb/vdb_voxels.hpp"

namespace voxelume::vdb {

/// The contents of a file.
struct VdbContent {
    openvdb::GridPtrVecPtr grids;
    openvdb::MetaMap::Ptr metadata;
};

/// Reads the contents. Each function throws Error::input for a file that is damaged, truncated, too
/// large for the memory, or without the content that is asked for.
VdbContent read_vdb_content(const InputFile& file);

VdbFileSummary summary_in(const InputFile& file);

/// Refuses a grid with a value, of an inactive cell, too, that isn't finite.
void check_values(const openvdb::FloatGrid& grid, const InputFile& file);

/// The grid of a density: float values, all finite, under an affine transform.
openvdb::FloatGrid::Ptr density_in(const InputFile& file, const std::string& grid);

std::unique_ptr<DensityField> density_field_of(openvdb::FloatGrid::ConstPtr grid,
                                               const glm::dmat4& world_from_grid);

/// The voxels of a model, and the grid that has the values of all other cells, too.
struct VdbModel {
    VdbVoxels voxels;
    openvdb::FloatGrid::Ptr grid;
};
VdbModel model_in(const VdbContent& content, const InputFile& file, Surface surface);

Volume volume_in(const InputFile& file);

}  // namespace voxelume::vdb
