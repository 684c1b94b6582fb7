// The steps of voxelizing a mesh, each a few kernels on what the steps before left in the job.
#pragma once

#include <glm/vec4.hpp>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"
#include "runtime/stages/voxelize/voxelize_bins.hpp"

namespace voxelume {

/// What the steps of one call share.
struct VoxelizeJob {
    const Device& device;
    DeviceTriangles triangles;  ///< the mesh's own
    DeviceTriangles caps;       ///< those that close its open outlines
    TriangleBins bins;          ///< of the stored bricks
    glm::ivec4 size, bricks;    ///< of the frame
    BrickGrid grid;             ///< what is being made

    /// Work-items of kernels that share a brick's slices out.
    size_t items() const;
};

/// The build constants of such kernels.
Defines slice_defines(const Device& device);

/// Voxel edges in the shortest one.
glm::vec4 edge_scale(const GridFrame& frame);

/// `band` shortest edges in lattice units along each axis, rounded up.
glm::ivec3 band_reach(const GridFrame& frame, double band);

/// Winding numbers of a closed mesh.
struct Windings {
    Buffer<int16_t> numbers;  ///< 4096 per brick with triangles, from its left face
    Buffer<int16_t> carried;  ///< 256 per bin with triangles: at its left face
    Buffer<int16_t> passing;  ///< one per brick of the frame: of those without triangles
};

/// The arrays of winding numbers in `stored` bricks and `bins` with triangles of a frame of
/// `places` bricks; of the rows of stored bricks' points, which are inside; of triangles' shapes.
Windings allocate_windings(const Device& device, size_t stored, size_t bins, size_t places);
Buffer<uint16_t> allocate_inside(const Device& device, size_t stored);
Buffer<float> allocate_shapes(const Device& device, size_t triangles);

/// Vectors and lengths of each triangle that do not depend on a brick, for distances.
Buffer<float> shape_triangles(const VoxelizeJob& job, const Program& distance);

/// SUPERCOVER or THIN occupancy, as `cover` was built.
void cover_bricks(VoxelizeJob& job, const Program& cover);

/// Marks the bricks that are not stored as outside.
void mark_outside(VoxelizeJob& job, const Program& bin);

/// Finds which points (voxels' centres or corners, as `winding` was built) are inside, and marks
/// the bricks that are not stored.
Buffer<uint16_t> find_inside(VoxelizeJob& job, const Program& winding);

/// The same for a mesh whose open outlines are closed by the job's caps: inside is where the
/// generalized winding number is above 1/2. Stores also the bricks that it crosses far from any
/// triangle. `cap_bins` holds the caps, `all_bins` caps and triangles.
Buffer<uint16_t> find_inside_open(VoxelizeJob& job, const Program& winding, const Program& caps,
                                  const TriangleBins& cap_bins, const TriangleBins& all_bins);

/// SOLID occupancy.
void fill_solid(VoxelizeJob& job, const Program& winding, const Buffer<uint16_t>& inside);

/// The distance field.
void measure_distances(VoxelizeJob& job, const Program& distance, const Buffer<uint16_t>& inside,
                       double band);

/// The triangles of each voxel.
void list_primitives(VoxelizeJob& job, const Program& exact);

/// What voxels take from the mesh's groups and colours.
struct MeshLabels {
    uint32_t attributes = 0;                    ///< of a voxel that has no triangle
    std::vector<uint32_t> triangle_attributes;  ///< empty: one word for all
    std::vector<glm::vec3> vertex_colors;       ///< linear; empty: none
};

/// `attributes` and `colors` by each voxel's closest triangle. `lists` holds the triangles within
/// `label_reach` of each brick.
void label_voxels(VoxelizeJob& job, const Program& label, const Program& distance,
                  const TriangleBins& lists, const MeshLabels& labels);

/// How far from a brick a triangle can be the closest of a voxel that any surface concerns.
glm::ivec3 label_reach(const GridFrame& frame);

}  // namespace voxelume
