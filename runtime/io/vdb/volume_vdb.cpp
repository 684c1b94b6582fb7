// SPDX-License-Identifier: Apache-2.0
// Volumetric image <-> OpenVDB: grids density, alpha, Cd, depth, object and kind, each with the
// display's transform. A lattice has an affine one, sight rays of a pyramid a frustum.
#include <openvdb/openvdb.h>

#include <algorithm>
#include <cmath>
#include <glm/trigonometric.hpp>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/vdb/vdb_read.hpp"
#include "runtime/io/vdb/vdb_stream.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume::vdb {

namespace {

/// The matrix for OpenVDB, which multiplies rows: the images of the axes, then of the origin.
openvdb::Mat4d rows_of(const glm::dmat4& m) {
    openvdb::Mat4d rows;
    for (int row = 0; row < 4; ++row)
        for (int column = 0; column < 4; ++column) rows(row, column) = m[row][column];
    return rows;
}

/// The frustum of a pyramid's rays. Its front side is one unit wide at z = 0; its second map gives
/// it its size and position.
openvdb::math::MapBase::Ptr pyramid_map(const VolumeFrame& frame) {
    const glm::dvec3 size(frame.size);
    const double near = frame.display.near, length = frame.step * size.z;
    const glm::dvec2 half = half_extent(frame.display) * near;
    glm::dmat4 observer_from_frustum(1);
    observer_from_frustum[0][0] = -2 * half.x;
    observer_from_frustum[1][1] = -2 * half.y * size.x / size.y;
    observer_from_frustum[2][2] = length;
    observer_from_frustum[3][2] = near;
    const openvdb::math::MapBase::Ptr second(
        new openvdb::math::AffineMap(rows_of(frame.world_from_observer * observer_from_frustum)));
    const openvdb::BBoxd box(openvdb::Vec3d(-0.5),
                             openvdb::Vec3d(size.x, size.y, size.z) - openvdb::Vec3d(0.5));
    return openvdb::math::MapBase::Ptr(
        new openvdb::math::NonlinearFrustumMap(box, near / (near + length), 1.0, second));
}

/// The transform of the grids. OpenVDB's values stand at integer coordinates, so the transform puts
/// them in the middle of the display's voxels.
openvdb::math::Transform::Ptr make_transform(const VolumeFrame& frame) {
    const std::optional<glm::dmat4> linear = world_from_voxels(frame);
    if (!linear) return std::make_shared<openvdb::math::Transform>(pyramid_map(frame));
    glm::dmat4 world_from_index = *linear;
    world_from_index[3] = *linear * glm::dvec4(0.5, 0.5, 0.5, 1);
    return openvdb::math::Transform::createLinearTransform(rows_of(world_from_index));
}

openvdb::Coord coord_of(const VolumeFrame& frame, uint64_t index) {
    const glm::ivec3 cell = cell_of(frame, index);
    return {cell.x, cell.y, cell.z};
}

/// The listed voxels, ordered by leaf of 8 x 8 x 8 each: OpenVDB's accessors are slow across
/// leaves.
std::vector<uint32_t> order_by_leaf(const Volume& volume) {
    std::vector<std::pair<uint64_t, uint32_t>> order;
    order.reserve(volume.indices.size());
    for (uint32_t i = 0; i < volume.indices.size(); ++i) {
        const glm::ivec3 leaf = cell_of(volume.frame, volume.indices[i]) / 8;
        order.emplace_back(uint64_t(leaf.x) | uint64_t(leaf.y) << 16 | uint64_t(leaf.z) << 32, i);
    }
    std::ranges::sort(order);
    std::vector<uint32_t> voxels;
    voxels.reserve(order.size());
    for (const auto& [leaf, i] : order) voxels.push_back(i);
    return voxels;
}

/// Makes grids that list the same voxels as each other.
class GridMaker {
  public:
    explicit GridMaker(const Volume& volume) : volume_(volume), order_(order_by_leaf(volume)) {}

    /// `value_at(i)` is the value of the i-th listed voxel.
    template <class Grid, class ValueAt>
    typename Grid::Ptr make(const char* name, ValueAt value_at) const {
        auto grid = Grid::create();
        auto accessor = grid->getAccessor();
        for (const uint32_t i : order_)
            accessor.setValue(coord_of(volume_.frame, volume_.indices[i]), value_at(i));
        grid->setName(name);
        grid->setTransform(make_transform(volume_.frame));
        return grid;
    }

  private:
    const Volume& volume_;
    std::vector<uint32_t> order_;
};

/// The extinction per metre that gives the opacity over `length` metres. An opaque voxel lets
/// 1/1024 of the light through.
float density_of(float opacity, double length) {
    const double through = std::max(1.0 - double(opacity), 1.0 / 1024);
    return static_cast<float>(-std::log(through) / length);
}

openvdb::GridCPtrVec make_grids(const Volume& volume) {
    using openvdb::FloatGrid;
    using openvdb::Int32Grid;
    const VolumeFrame& frame = volume.frame;
    const GridMaker maker(volume);
    const double length = frame.layout == VolumeLayout::lattice ? frame.edge.z : frame.step;
    auto density = maker.make<FloatGrid>(
        "density", [&](size_t i) { return density_of(volume.opacities[i], length); });
    auto alpha = maker.make<FloatGrid>("alpha", [&](size_t i) { return volume.opacities[i]; });
    auto color = maker.make<openvdb::Vec3SGrid>("Cd", [&](size_t i) {
        const glm::vec3& c = volume.colors[i];
        return openvdb::Vec3s(c.r, c.g, c.b);
    });
    auto depth = maker.make<FloatGrid>("depth", [&](size_t i) { return volume.depths[i]; });
    auto object = maker.make<Int32Grid>(
        "object", [&](size_t i) { return static_cast<int32_t>(volume.objects[i]); });
    auto kind =
        maker.make<Int32Grid>("kind", [&](size_t i) { return static_cast<int>(volume.kinds[i]); });
    density->setGridClass(openvdb::GRID_FOG_VOLUME);
    alpha->setGridClass(openvdb::GRID_FOG_VOLUME);
    color->setVectorType(openvdb::VEC_INVARIANT);
    return {density, alpha, color, depth, object, kind};
}

/// The grids of a file that is known to be unchanged since it was written.
struct VolumeGrids {
    openvdb::FloatGrid::Ptr alpha, depth;
    openvdb::Vec3SGrid::Ptr color;
    openvdb::Int32Grid::Ptr object, kind;

    bool complete() const { return alpha && depth && color && object && kind; }
};

VolumeGrids take_grids(const openvdb::GridPtrVec& all) {
    const auto named = [&all](const char* name) { return openvdb::findGridByName(all, name); };
    VolumeGrids grids;
    grids.alpha = openvdb::gridPtrCast<openvdb::FloatGrid>(named("alpha"));
    grids.depth = openvdb::gridPtrCast<openvdb::FloatGrid>(named("depth"));
    grids.color = openvdb::gridPtrCast<openvdb::Vec3SGrid>(named("Cd"));
    grids.object = openvdb::gridPtrCast<openvdb::Int32Grid>(named("object"));
    grids.kind = openvdb::gridPtrCast<openvdb::Int32Grid>(named("kind"));
    return grids;
}

/// A voxel before the voxels are sorted by `index`.
struct FoundVoxel {
    uint64_t index = 0;
    openvdb::Vec3s color;
    float opacity = 0, depth = 0;
    int32_t object = 0, kind = 0;
};

/// The active voxels of `alpha` in ascending order, with the other grids' values there.
std::vector<FoundVoxel> find_voxels(const InputFile& readable, const VolumeFrame& frame,
                                    const VolumeGrids& grids) {
    const glm::ivec3& size = frame.size;
    auto depth = grids.depth->getConstAccessor();
    auto color = grids.color->getConstAccessor();
    auto object = grids.object->getConstAccessor(), kind = grids.kind->getConstAccessor();
    std::vector<FoundVoxel> voxels;
    voxels.reserve(grids.alpha->activeVoxelCount());
    for (auto value = grids.alpha->cbeginValueOn(); value; ++value) {
        const openvdb::Coord c = value.getCoord();
        if (!value.isVoxelValue() || c.x() < 0 || c.y() < 0 || c.z() < 0 || c.x() >= size.x ||
            c.y() >= size.y || c.z() >= size.z)
            readable.refuse("a voxel lies outside of the display");
        const uint64_t index =
            uint64_t(c.x()) +
            uint64_t(size.x) * (uint64_t(c.y()) + uint64_t(size.y) * uint64_t(c.z()));
        voxels.push_back({index, color.getValue(c), *value, depth.getValue(c), object.getValue(c),
                          kind.getValue(c)});
    }
    std::ranges::sort(voxels, {}, &FoundVoxel::index);
    return voxels;
}

}  // namespace

Volume volume_in(const InputFile& readable) {
    const VdbContent content = read_vdb_content(readable);
    const openvdb::MetaMap::Ptr& metadata = content.metadata;
    const auto frame = metadata->getMetadata<openvdb::StringMetadata>(kFrameKey);
    if (!frame) readable.refuse("an OpenVDB file, but not of a display");
    Volume volume;
    volume.frame = read_frame_text(frame->value(), readable.path().string());
    for (auto entry = metadata->beginMeta(); entry != metadata->endMeta(); ++entry)
        if (entry->second->typeName() == "string" && entry->first != kFrameKey)
            volume.attributes[entry->first] = entry->second->str();
    const VolumeGrids grids = take_grids(*content.grids);
    if (!grids.complete()) readable.refuse("its grids aren't those of a display");
    for (const FoundVoxel& voxel : find_voxels(readable, volume.frame, grids)) {
        volume.indices.push_back(voxel.index);
        volume.colors.emplace_back(voxel.color.x(), voxel.color.y(), voxel.color.z());
        volume.opacities.push_back(voxel.opacity);
        volume.depths.push_back(voxel.depth);
        volume.objects.push_back(static_cast<uint32_t>(voxel.object));
        volume.kinds.push_back(static_cast<VoxelKind>(std::clamp(voxel.kind, 0, 2)));
    }
    return volume;
}

void write_volume_vdb(const VolumePath& path, const Volume& volume) {
    AtomicFile file(path);
    if (volume.indices.size() > UINT32_MAX)
        file.fail("it has more than 2^32 voxels that show something");
    openvdb::initialize();
    openvdb::MetaMap metadata;
    for (const auto& [key, text] : volume.attributes)
        metadata.insertMeta(key, openvdb::StringMetadata(text));
    metadata.insertMeta(kFrameKey, openvdb::StringMetadata(write_frame_text(volume.frame)));
    write_vdb_grids(file, make_grids(volume), metadata);
    file.commit();
}

}  // namespace voxelume::vdb
