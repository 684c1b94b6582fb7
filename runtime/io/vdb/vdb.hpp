// SPDX-License-Identifier: Apache-2.0
// Voxels -> OpenVDB, and summaries of OpenVDB files.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <optional>
#include <span>
#include <string>
#include <vector>

namespace voxelume {

/// The meaning of the values for programs that read the grid.
enum class VdbClass {
    level_set,  ///< signed distance in metres, negative inside
    fog         ///< density or coverage
};

/// A float grid of scattered voxels, with a colour grid when there are colours.
///
/// The spans have equal lengths (`colors` may be empty) and outlive the call. A cell that is listed
/// twice has its last value.
struct VdbVolume {
    std::string name = "density";
    VdbClass grid_class = VdbClass::fog;
    std::span<const glm::ivec3> cells;
    std::span<const float> values;
    std::span<const glm::vec3> colors;  ///< linear Rec. 709, written as grid `Cd`
    float background = 0.0f;  ///< value of all other cells; for a level set the band's half width
    glm::dvec3 voxel_edges{1.0};  ///< metres
    glm::dvec3 origin{0.0};       ///< world position of the value of cell (0, 0, 0), metres
    std::map<std::string, std::string> metadata;  ///< text entries for the file
};

/// Writes the grids. Equal volumes give equal bytes: an identifier from the content replaces
/// OpenVDB's random one. Throws Error::output.
void write_vdb(const std::filesystem::path& path, const VdbVolume& volume);

/// Throws Error::output where write_vdb and write_volume_vdb would throw for every volume because
/// OpenVDB can't be loaded.
void check_vdb_output(const std::filesystem::path& path);

/// Sets whether OpenVDB reads files in a helper program, since damaged ones corrupt the memory of
/// the process that reads them. It does unless this function says otherwise.
void isolate_vdb_readers(bool is_isolated);

/// A summary of one grid of a file.
struct VdbSummary {
    std::string name;
    std::string value_type;  ///< "float", "vec3s", ...
    std::string grid_class;  ///< "level set", "fog volume", ... or "unknown"
    uint64_t active_voxels = 0;
    glm::ivec3 min{0}, max{0};    ///< cells of the active voxels' bounds, both included
    glm::dvec3 voxel_edges{0.0};  ///< metres
};

/// A summary of a file.
struct VdbFileSummary {
    std::map<std::string, std::string> metadata;  ///< text entries alone
    std::vector<VdbSummary> grids;
};

/// Reads every grid of a file. Throws Error::input for a file that is missing or that OpenVDB can't
/// read.
VdbFileSummary read_vdb_summary(const std::filesystem::path& path);

/// True if a file's identifier is the one that its content has in files of voxelume; empty for a
/// file of another program. Throws Error::input for a file that can't be read.
std::optional<bool> is_vdb_as_written(const std::filesystem::path& path);

}  // namespace voxelume
