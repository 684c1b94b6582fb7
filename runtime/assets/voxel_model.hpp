// Files of voxels (.vxm, OpenVDB) -> models that need no voxelizing.
#pragma once

#include <filesystem>
#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid.hpp"

namespace voxelume {

/// A BrickGrid in main memory, as it comes from a file.
struct VoxelModel {
    GridFrame frame;
    Surface surface = Surface::cubes;
    VoxelSet set = VoxelSet::supercover;
    std::vector<uint32_t> slots, coordinates;
    std::vector<uint64_t> occupancy;
    std::vector<int16_t> distance;
    std::vector<uint32_t> attributes, colors;
    bool transparent = false;         ///< some voxel isn't opaque
    std::vector<std::string> groups;  ///< what the attributes' materials are named
    Mesh mesh;                        ///< of exact surfaces: their triangles, and nothing else

    size_t voxels() const;  ///< that are occupied, or near a smooth surface
    BrickGrid upload(const Device& device) const;
};

class InputFile;

/// Bricks in the table of a frame.
size_t bricks_of(const GridFrame& frame);

/// Throw Error::input for more voxels along the axes, or stored bricks, than a model may have.
void check_voxel_span(const glm::dvec3& size, const InputFile& file);
void check_stored_bricks(size_t stored, const InputFile& file);

/// Reads a model by what its file begins with.
///
/// .vxm: its own surface must be `surface`. OpenVDB: as cubes the voxels of a fog whose value is
/// above 0, covering by that value, at most 1, with the colours of `Cd`; as smooth a level set.
/// Throws Error::input for a file that is missing, damaged or holds another surface.
VoxelModel read_voxel_model(const std::filesystem::path& file, Surface surface);

}  // namespace voxelume
