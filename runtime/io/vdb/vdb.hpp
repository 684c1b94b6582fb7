// Voxels -> OpenVDB, and what is in an OpenVDB file.
#pragma once

#include <cstdint>
#include <filesystem>
#include <glm/vec3.hpp>
#include <map>
#include <span>
#include <string>
#include <vector>

namespace voxelume {

/// What the values mean to the programs that read the grid.
enum class VdbClass {
    level_set,  ///< signed distance in metres, negative inside
    fog         ///< density or coverage
};

/// A float grid of scattered voxels, and a colour grid beside it when there are colours.
///
/// The spans are as long as each other (`colors` may be empty) and outlive the call. A cell named
/// twice has its last value.
struct VdbVolume {
    std::string name = "density";
    VdbClass grid_class = VdbClass::fog;
    std::span<const glm::ivec3> cells;
    std::span<const float> values;
    std::span<const glm::vec3> colors;  ///< linear Rec. 709, written as grid `Cd`
    float background = 0.0f;  ///< the value everywhere else; for a level set the band's half width
    glm::dvec3 voxel_edges{1.0};  ///< metres
    glm::dvec3 origin{0.0};       ///< world position of the value of cell (0, 0, 0), metres
    std::map<std::string, std::string> metadata;  ///< text for the file
};

/// Writes the grids. The same volume gives the same bytes: OpenVDB's random identifier is replaced
/// by one from the content. Throws Error::output.
void write_vdb(const std::filesystem::path& path, const VdbVolume& volume);

/// Throws Error::output where write_vdb and write_volume_vdb would for any volume, as OpenVDB can't
/// be loaded.
void check_vdb_output(const std::filesystem::path& path);

/// One grid of a file.
struct VdbSummary {
    std::string name;
    std::string value_type;  ///< "float", "vec3s", ...
    std::string grid_class;  ///< "level set", "fog volume", ... or "unknown"
    uint64_t active_voxels = 0;
    glm::ivec3 min{0}, max{0};    ///< cells of the active voxels' bounds, both included
    glm::dvec3 voxel_edges{0.0};  ///< metres
};

/// The file's own texts. Throws as read_vdb_summary does.
std::map<std::string, std::string> read_vdb_metadata(const std::filesystem::path& path);

/// Reads every grid of a file. Throws Error::input for a file that is missing or that OpenVDB can't
/// read.
std::vector<VdbSummary> read_vdb_summary(const std::filesystem::path& path);

}  // namespace voxelume
