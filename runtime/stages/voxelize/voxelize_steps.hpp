// SPDX-License-Identifier: Apache-2.0
// The steps of voxelizing a mesh. Each runs a few kernels on the results of earlier steps in the
// job.
#pragma once

#include <glm/vec4.hpp>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/voxelize/mesh_lattice.hpp"
#include "runtime/stages/voxelize/voxelize_bins.hpp"

namespace voxelume {

/// The state that the steps of one call share.
struct VoxelizeJob {
    const Device& device;
    DeviceTriangles triangles;  ///< triangles of the mesh
    DeviceTriangles caps;       ///< the triangles that close its open outlines
    TriangleBins bins;          ///< the bins of the stored bricks
    glm::ivec4 size, bricks;    ///< size of the frame in voxels and in bricks
    BrickGrid grid;             ///< the result so far
    bool has_points = false;    ///< the mesh is points and lines alone

    /// The number of work-items of kernels that divide a brick's slices among work-items.
    size_t items() const;
};

/// The build constants of kernels that divide a brick's slices among work-items.
Defines slice_defines(const Device& device);

/// The voxel's edges, in units of the shortest one.
glm::vec4 edge_scale(const GridFrame& frame);

/// The length of `band` shortest edges in lattice units along each axis, rounded up.
glm::ivec3 band_reach(const GridFrame& frame, double band);

/// Winding numbers of a closed mesh.
struct Windings {
    Buffer<int16_t> numbers;     ///< 4096 per brick with triangles, from its left face
    Buffer<int16_t> row_starts;  ///< 256 per bin with triangles: numbers at its left face
    Buffer<int16_t> passing;     ///< one per brick of the frame: in those without triangles
};

/// VXL_WINDING_PARAMETERS of kernels.
void bind(KernelArguments& to, const Windings& windings);

/// Allocates winding numbers for `stored` bricks and `bins` with triangles, in a frame of
/// `frame_bricks` bricks. The other two functions allocate the rows of inside points of stored
/// bricks, and the shapes of triangles.
Windings allocate_windings(const Device& device, size_t stored, size_t bins, size_t frame_bricks);
Buffer<uint16_t> allocate_inside(const Device& device, size_t stored);
Buffer<float> allocate_shapes(const Device& device, size_t triangles);

/// The vectors and lengths of each triangle that do not depend on a brick, for distances.
Buffer<float> shape_triangles(const VoxelizeJob& job, const Program& distance);

/// Computes the SUPERCOVER or THIN occupancy, whichever `cover` was built for.
void cover_bricks(VoxelizeJob& job, const Program& cover);

/// Marks the bricks that are not stored as outside.
void mark_outside(VoxelizeJob& job, const Program& bin);

/// Finds which points (voxels' centres or corners, whichever `winding` was built for) are inside,
/// and marks the bricks that are not stored.
Buffer<uint16_t> find_inside(VoxelizeJob& job, const Program& winding);

/// Finds the inside of a mesh whose open outlines are closed by the job's caps: the points where
/// the generalized winding number is above 1/2. Also stores the bricks that the boundary of this
/// inside crosses far from any triangle. `cap_bins` holds the caps, `all_bins` caps and triangles.
Buffer<uint16_t> find_inside_open(VoxelizeJob& job, const Program& winding, const Program& caps,
                                  const TriangleBins& cap_bins, const TriangleBins& all_bins);

/// Computes the SOLID occupancy.
void fill_solid(VoxelizeJob& job, const Program& winding, const Buffer<uint16_t>& inside);

/// Computes the distance field within `band` shortest edges of the surface.
void measure_distances(VoxelizeJob& job, const Program& distance, const Buffer<uint16_t>& inside,
                       double band);

/// Lists the triangles of each voxel.
void list_primitives(VoxelizeJob& job, const Program& exact);

/// The values that voxels take from the mesh's groups, colours and normals.
struct MeshLabels {
    uint32_t attributes = 0;                    ///< value for voxels without a triangle
    std::vector<uint32_t> triangle_attributes;  ///< empty: one value for all triangles
    const Mesh* mesh = nullptr;                 ///< mesh with the colours
    bool has_normals = false;                   ///< cubes get normals of the surface
    std::vector<uint32_t> corner_normals{};     ///< as in BrickGrid::triangle_normals; empty: each
                                                ///< triangle's own
};

/// True for a mesh that gives its voxels colours.
bool has_paint(const Mesh& mesh);

/// The build constants of the kernels that label voxels.
Defines label_defines(const Device& device, const MeshLabels& labels);

/// Gives each voxel the packed attributes, the colour and the normal of its closest triangle.
/// `lists` holds the triangles within `label_reach` of each brick.
void label_voxels(VoxelizeJob& job, const Program& label, const Program& distance,
                  const TriangleBins& lists, const MeshLabels& labels);

/// The maximum distance from a brick, in lattice units, of a triangle that is the closest one of
/// any of its voxels that a surface concerns.
glm::ivec3 label_reach(const GridFrame& frame);

}  // namespace voxelume
