// SPDX-License-Identifier: Apache-2.0
// mesh -> object grid: the voxels that a triangle mesh covers or fills, or its distance field.
#pragma once

#include <glm/mat4x4.hpp>
#include <string>

#include "runtime/geometry/mesh.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/voxelize/voxelize_options.hpp"

namespace voxelume {

struct DeviceTriangles;
struct TriangleBins;
struct VoxelizeJob;

/// Voxelizes meshes on one device.
class Voxelizer {
  public:
    explicit Voxelizer(const Device& device) : device_(device) {}

    /// The voxels of `mesh` in `frame`. Parts of the mesh outside of the frame are left out.
    ///
    /// `frame_from_mesh` maps the mesh's space to the frame's. Open meshes are inside where their
    /// generalized winding number (Jacobson et al. 2013) is above 1/2, so small holes close, and a
    /// shell turned inside out is empty. Stored bricks:
    ///   cubes   every brick that holds a triangle. For SOLID these have their full occupancy, and
    ///           bricks marked kBrickInside are full. A mesh of points and lines alone has one set:
    ///           a point is in one voxel, of two that touch it the upper one.
    ///   smooth  every brick with a node within `band` of the surface, and every brick whose nodes
    ///           are not all on one side. Distances are exact to their rounding within the band and
    ///           saturated (±32767) beyond.
    ///   exact   as cubes, with the triangles of each voxel in ascending order. Voxels are widened
    ///           by a unit of the lattice, since rays meet corners that aren't snapped to it.
    /// `attributes` is empty for a mesh with one group, `colors` for a mesh without colours.
    /// Otherwise a voxel has the group of the triangle closest to its centre (of equally close ones
    /// the triangle with the lowest number) and the colour of that triangle's closest point. Voxels
    /// that no surface concerns have group 0 and are white. Materials are face groups, object is 0.
    /// Throws Error::input for a mesh without triangles, with NaNs or bad indices; Error::limit for
    /// more than 16384 voxels along an axis or if memory doesn't suffice.
    BrickGrid voxelize(const Mesh& mesh, const glm::dmat4& frame_from_mesh, const GridFrame& frame,
                       const VoxelizeOptions& options);

  private:
    /// The voxels of a mesh whose faces look outwards in the frame, not in its own space.
    BrickGrid voxelize_outward(const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                               const GridFrame& frame, const VoxelizeOptions& options);
    TriangleBins bin(const VoxelizeJob& job, const DeviceTriangles& triangles,
                     const glm::ivec3& reach, int extent);
    Buffer<uint16_t> inside(VoxelizeJob& job, bool centers, const glm::ivec3& reach);
    void voxelize_smooth(VoxelizeJob& job, double band);
    void voxelize_cubes(VoxelizeJob& job, VoxelSet set, int margin);
    Program program(const std::string& file, const Defines& defines) const;

    Device device_;
};

/// The voxels of a single mesh, as Voxelizer::voxelize gives them.
BrickGrid voxelize_mesh(const Device& device, const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                        const GridFrame& frame, const VoxelizeOptions& options);

/// The frame with voxels of `voxel_edge` (metres) that holds the mesh in its own space, plus
/// `margin` voxels on every side. Four voxels hold all distances of `smooth`.
GridFrame frame_around(const Mesh& mesh, const glm::dvec3& voxel_edge, int margin = 4);

/// The frame around a mesh whose vertices span the box `low`..`high`.
GridFrame frame_around(const glm::dvec3& low, const glm::dvec3& high, const glm::dvec3& voxel_edge,
                       int margin = 4);

}  // namespace voxelume
