// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/mesh_lattice.hpp"

#include <algorithm>
#include <cmath>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

void check_indices(const Mesh& mesh) {
    if (mesh.triangles.empty())
        throw Error(ErrorKind::input, "the mesh has no triangles: there is nothing to voxelize");
    const size_t count = mesh.positions.size();
    for (size_t i = 0; i < mesh.triangles.size(); ++i) {
        const glm::uvec3& t = mesh.triangles[i];
        if (std::max({t.x, t.y, t.z}) >= count)
            throw Error(ErrorKind::input,
                        "triangle {} of the mesh names vertex {}, but the mesh has {} vertices", i,
                        std::max({t.x, t.y, t.z}), count);
    }
}

glm::ivec3 snap(const glm::dvec3& voxels, size_t vertex) {
    glm::ivec3 snapped;
    for (int a = 0; a < 3; ++a) {
        if (!std::isfinite(voxels[a]))
            throw Error(ErrorKind::input, "vertex {} of the mesh is not a finite point", vertex);
        if (std::abs(voxels[a]) > kLatticeReach)
            throw Error(ErrorKind::limit,
                        "vertex {} of the mesh is {:.0f} voxels from the grid's origin, more than "
                        "{}: if that is wrong, give its model another \"unit\"; if not, use larger "
                        "voxels",
                        vertex, std::abs(voxels[a]), kLatticeReach);
        snapped[a] = static_cast<int>(std::nearbyint(voxels[a] * kLatticePerVoxel));
    }
    return snapped;
}

}  // namespace

glm::dvec3 to_voxels(const glm::vec3& position, const glm::dmat4& frame_from_mesh,
                     const GridFrame& frame) {
    const glm::dvec3 p(frame_from_mesh * glm::dvec4(position, 1.0));
    return (p - frame.origin) / frame.voxel_edge;
}

MeshLattice snap_to_lattice(const Mesh& mesh, const glm::dmat4& frame_from_mesh,
                            const GridFrame& frame) {
    check_indices(mesh);
    MeshLattice lattice;
    lattice.vertices.reserve(mesh.positions.size());
    for (size_t i = 0; i < mesh.positions.size(); ++i)
        lattice.vertices.push_back(snap(to_voxels(mesh.positions[i], frame_from_mesh, frame), i));
    lattice.triangles = mesh.triangles;
    lattice.surface_triangles = mesh.triangles.size();
    return lattice;
}

}  // namespace voxelume
