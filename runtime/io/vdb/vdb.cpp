// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/vdb/vdb.hpp"

#include <openvdb/openvdb.h>
#include <openvdb/tools/SignedFloodFill.h>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/io/vdb/vdb_read.hpp"
#include "runtime/io/vdb/vdb_stream.hpp"

namespace voxelume::vdb {

namespace {

openvdb::math::Transform::Ptr make_transform(const VdbVolume& volume) {
    const glm::dvec3& edges = volume.voxel_edges;
    const glm::dvec3& origin = volume.origin;
    const bool cube = edges.x == edges.y && edges.x == edges.z;
    auto transform = cube ? openvdb::math::Transform::createLinearTransform(edges.x)
                          : openvdb::math::Transform::createLinearTransform();
    if (!cube) transform->preScale(openvdb::Vec3d(edges.x, edges.y, edges.z));
    transform->postTranslate(openvdb::Vec3d(origin.x, origin.y, origin.z));
    return transform;
}

template <class Grid, class Value, class Convert>
typename Grid::Ptr make_grid(const VdbVolume& volume, std::span<const Value> values,
                             typename Grid::ValueType background, Convert convert) {
    auto grid = Grid::create(background);
    auto accessor = grid->getAccessor();
    for (size_t i = 0; i < volume.cells.size(); ++i) {
        const glm::ivec3& cell = volume.cells[i];
        accessor.setValue(openvdb::Coord(cell.x, cell.y, cell.z), convert(values[i]));
    }
    grid->setTransform(make_transform(volume));
    return grid;
}

openvdb::GridCPtrVec make_grids(const VdbVolume& volume) {
    auto values = make_grid<openvdb::FloatGrid>(volume, volume.values, volume.background,
                                                [](float value) { return value; });
    if (volume.grid_class == VdbClass::level_set)  // voxels inside the surface have no value yet
        openvdb::tools::signedFloodFill(values->tree());
    values->setName(volume.name);
    values->setGridClass(volume.grid_class == VdbClass::level_set ? openvdb::GRID_LEVEL_SET
                                                                  : openvdb::GRID_FOG_VOLUME);
    openvdb::GridCPtrVec grids = {values};
    if (volume.colors.empty()) return grids;
    auto colors = make_grid<openvdb::Vec3SGrid>(
        volume, volume.colors, openvdb::Vec3s(0.0f),
        [](const glm::vec3& color) { return openvdb::Vec3s(color.r, color.g, color.b); });
    colors->setName("Cd");
    colors->setVectorType(openvdb::VEC_INVARIANT);
    grids.push_back(colors);
    return grids;
}

void check_volume(AtomicFile& file, const VdbVolume& volume) {
    const size_t count = volume.cells.size();
    if (volume.values.size() != count) file.fail("not every voxel has a value");
    if (!volume.colors.empty() && volume.colors.size() != count)
        file.fail("not every voxel has a colour");
    if (!(volume.voxel_edges.x > 0 && volume.voxel_edges.y > 0 && volume.voxel_edges.z > 0))
        file.fail("the voxels have no size");
}

void write_grids(AtomicFile& file, const VdbVolume& volume) {
    openvdb::initialize();
    openvdb::MetaMap metadata;
    for (const auto& [key, text] : volume.metadata)
        metadata.insertMeta(key, openvdb::StringMetadata(text));
    write_vdb_grids(file, make_grids(volume), metadata);
}

VdbSummary summarize(const openvdb::GridBase& grid) {
    VdbSummary summary;
    summary.name = grid.getName();
    summary.value_type = grid.valueType();
    summary.grid_class = openvdb::GridBase::gridClassToString(grid.getGridClass());
    summary.active_voxels = grid.activeVoxelCount();
    if (summary.active_voxels > 0) {
        const openvdb::CoordBBox box = grid.evalActiveVoxelBoundingBox();
        summary.min = {box.min().x(), box.min().y(), box.min().z()};
        summary.max = {box.max().x(), box.max().y(), box.max().z()};
    }
    const openvdb::Vec3d edges = grid.voxelSize();
    summary.voxel_edges = {edges.x(), edges.y(), edges.z()};
    return summary;
}

}  // namespace

void write_vdb(const std::filesystem::path& path, const VdbVolume& volume) {
    AtomicFile file(path);
    check_volume(file, volume);
    write_grids(file, volume);
    file.commit();
}

VdbFileSummary summary_in(const InputFile& file) {
    const VdbContent content = read_vdb_content(file);
    VdbFileSummary summary;
    const openvdb::MetaMap& metadata = *content.metadata;
    for (auto entry = metadata.beginMeta(); entry != metadata.endMeta(); ++entry)
        if (entry->second->typeName() == "string")
            summary.metadata[entry->first] = entry->second->str();
    for (const openvdb::GridBase::Ptr& grid : *content.grids)
        summary.grids.push_back(summarize(*grid));
    return summary;
}

}  // namespace voxelume::vdb
