// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/peers/peer_level_set.hpp"

#include <openvdb/tools/GridTransformer.h>
#include <openvdb/tools/MeshToVolume.h>

namespace voxelume {
namespace {

openvdb::math::Transform::Ptr lattice(double voxel) {
    return openvdb::math::Transform::createLinearTransform(voxel);
}

}  // namespace

openvdb::FloatGrid::Ptr level_set(const Mesh& mesh, double voxel) {
    openvdb::initialize();
    std::vector<openvdb::Vec3s> points;
    for (const glm::vec3& p : mesh.positions) points.emplace_back(p.x, p.y, p.z);
    std::vector<openvdb::Vec3I> triangles;
    for (const auto& t : mesh.triangles) triangles.emplace_back(t[0], t[1], t[2]);
    return openvdb::tools::meshToLevelSet<openvdb::FloatGrid>(*lattice(voxel), points, triangles,
                                                              3.0f);
}

openvdb::FloatGrid::Ptr placed_level_set(openvdb::FloatGrid& grid, double voxel,
                                         const glm::dmat4& world_from_object) {
    openvdb::math::Mat4d map;  // of row vectors
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column)
            map[row][column] = world_from_object[row][column];
    const openvdb::FloatGrid::Ptr moved = grid.copy();  // shares the tree
    moved->setTransform(grid.transform().copy());
    moved->transform().postMult(map);
    const openvdb::FloatGrid::Ptr placed = openvdb::FloatGrid::create(grid.background());
    placed->setTransform(lattice(voxel));
    placed->setGridClass(openvdb::GRID_LEVEL_SET);
    openvdb::tools::resampleToMatch<openvdb::tools::BoxSampler>(*moved, *placed);
    return placed;
}

}  // namespace voxelume
