// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb_read.hpp"

#include <cmath>

namespace voxelume::vdb {
namespace {

using openvdb::FloatGrid;
using openvdb::Vec3d;

FloatGrid::Ptr find_grid(const openvdb::GridPtrVec& grids, Surface surface,
                         const InputFile& readable) {
    FloatGrid::Ptr found;
    for (const openvdb::GridBase::Ptr& grid : grids) {
        const auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
        if (!floats) continue;
        const bool level_set = floats->getGridClass() == openvdb::GRID_LEVEL_SET;
        if (level_set != stores_distances(surface)) continue;
        if (!found || floats->getName() == "density") found = floats;
    }
    if (!found)
        readable.refuse(stores_distances(surface)
                            ? "has no level set of float values, which a smooth surface is made of"
                            : "has no fog of float values, which cubes are made of; give a level "
                              "set \"surface\": \"smooth\"");
    return found;
}

/// The edges of the grid's cells, metres. Refuses a grid whose cells don't lie along the axes.
glm::dvec3 cell_edges(const FloatGrid& grid, const InputFile& readable) {
    const Vec3d origin = grid.indexToWorld(Vec3d(0.0));
    glm::dvec3 edges;
    bool straight = grid.transform().isLinear();
    for (int axis = 0; axis < 3; ++axis) {
        Vec3d unit(0.0);
        unit[axis] = 1;
        const Vec3d step = grid.indexToWorld(unit) - origin;
        for (int other = 0; other < 3; ++other)
            straight &= other == axis ? std::isfinite(step[axis]) && step[axis] > 0
                                      : std::abs(step[other]) <= 1e-12 * std::abs(step[axis]);
        edges[axis] = step[axis];
    }
    if (!straight)
        readable.refuse(
            fmt::format("grid \"{}\" is turned or bent by its transform; turn the object "
                        "that shows it instead",
                        grid.getName()));
    return edges;
}

VdbModel take_voxels(const openvdb::GridPtrVec& grids, Surface surface, const InputFile& readable) {
    const FloatGrid::Ptr grid = find_grid(grids, surface, readable);
    if (stores_distances(surface)) check_values(*grid, readable);  // of inactive cells, too
    VdbVoxels voxels;
    voxels.voxel_edges = cell_edges(*grid, readable);
    const Vec3d origin = grid->indexToWorld(Vec3d(0.0));
    voxels.origin = {origin.x(), origin.y(), origin.z()};
    const uint64_t count = grid->activeVoxelCount();
    if (count > kMaxVdbVoxels)
        readable.refuse(fmt::format("grid \"{}\" has {} voxels, at most {} are possible",
                                    grid->getName(), count, kMaxVdbVoxels));
    openvdb::Vec3SGrid::Ptr colors;
    for (const openvdb::GridBase::Ptr& other : grids)
        if (other->getName() == "Cd") colors = openvdb::gridPtrCast<openvdb::Vec3SGrid>(other);
    grid->tree().voxelizeActiveTiles();
    for (auto value = grid->cbeginValueOn(); value; ++value) {
        if (!std::isfinite(*value))
            readable.refuse(
                fmt::format("grid \"{}\" has a value that is no number", grid->getName()));
        const openvdb::Coord cell = value.getCoord();
        voxels.cells.emplace_back(cell.x(), cell.y(), cell.z());
        voxels.values.push_back(*value);
        if (!colors) continue;
        const openvdb::Vec3s color = colors->tree().getValue(cell);
        if (!std::isfinite(color.x()) || !std::isfinite(color.y()) || !std::isfinite(color.z()))
            readable.refuse("grid \"Cd\" has a value that is no number");
        voxels.colors.emplace_back(color.x(), color.y(), color.z());
    }
    return {std::move(voxels), grid};
}

}  // namespace

VdbModel model_in(const VdbContent& content, const InputFile& file, Surface surface) {
    return take_voxels(*content.grids, surface, file);
}

}  // namespace voxelume::vdb
