// SPDX-License-Identifier: Apache-2.0
#include <openvdb/tools/Interpolation.h>

#include <algorithm>
#include <cmath>
#include <glm/matrix.hpp>

#include "runtime/io/vdb/vdb_read.hpp"

namespace voxelume::vdb {
namespace {

using openvdb::Coord;
using openvdb::CoordBBox;
using openvdb::FloatGrid;

constexpr int kLeafEdge = FloatGrid::TreeType::LeafNodeType::DIM;

float density_of(float value) {
    return std::fmax(value, 0.0f);
}

class VdbField : public DensityField {
  public:
    VdbField(FloatGrid::ConstPtr grid, const glm::dmat4& world_from_grid)
        : grid_(std::move(grid)),
          grid_from_world_(glm::inverse(world_from_grid)),
          active_(grid_->evalActiveVoxelBoundingBox()) {}

    std::optional<float> constant_in(const Bounds& box) const override {
        const std::optional<float> value = value_in(box);
        return value ? std::optional(density_of(*value)) : std::nullopt;
    }

    ValueRange range_in(const Bounds& box) const override {
        if (const auto value = value_in(box)) return {double(*value), double(*value)};
        return DensityField::range_in(box);
    }

    void sample(const glm::dvec3& first, const glm::dvec3& step,
                std::span<float, 4096> densities) const override {
        sample_values(first, step, glm::ivec3(16), densities);
        for (float& density : densities) density = density_of(density);
    }

    void sample_values(const glm::dvec3& first, const glm::dvec3& step, const glm::ivec3& count,
                       std::span<float> values) const override {
        const auto accessor = grid_->getConstAccessor();
        size_t index = 0;
        for (int z = 0; z < count.z; ++z)
            for (int y = 0; y < count.y; ++y)
                for (int x = 0; x < count.x; ++x) {
                    const glm::dvec3 p = first + step * glm::dvec3(x, y, z);
                    openvdb::tools::BoxSampler::sample(accessor, near_active(index_of(p)),
                                                       values[index++]);
                }
    }

    bool is_zero() const override {
        for (auto value = grid_->cbeginValueAll(); value; ++value)
            if (density_of(*value) > 0) return false;
        return density_of(grid_->background()) == 0;
    }

    double bytes() const override { return double(grid_->memUsage()); }

  private:
    /// The value in a whole box, if it is known to be constant there.
    std::optional<float> value_in(const Bounds& box) const {
        CoordBBox cells = cells_around(box);
        const float outside = grid_->background();
        if (!cells.hasOverlap(active_)) return outside;
        const bool reaches_out = !active_.isInside(cells);
        cells.intersect(active_);
        const auto accessor = grid_->getConstAccessor();
        const float one = reaches_out ? outside : accessor.getValue(cells.min());
        const Coord corner = cells.min() & ~(kLeafEdge - 1);
        for (int z = corner.z(); z <= cells.max().z(); z += kLeafEdge)
            for (int y = corner.y(); y <= cells.max().y(); y += kLeafEdge)
                for (int x = corner.x(); x <= cells.max().x(); x += kLeafEdge) {
                    const Coord leaf(x, y, z);
                    if (accessor.probeConstLeaf(leaf) || accessor.getValue(leaf) != one)
                        return std::nullopt;
                }
        return one;
    }

    openvdb::Vec3d index_of(const glm::dvec3& world) const {
        const glm::dvec3 p(grid_from_world_ * glm::dvec4(world, 1));
        return grid_->worldToIndex(openvdb::Vec3d(p.x, p.y, p.z));
    }

    /// The point, clamped to two cells around the active voxels, so that far points stay within the
    /// range of coordinates.
    openvdb::Vec3d near_active(openvdb::Vec3d p) const {
        for (int a = 0; a < 3; ++a)
            p[a] = std::clamp(p[a], active_.min()[a] - 2.0, active_.max()[a] + 2.0);
        return p;
    }

    /// All cells whose values influence points of a box, clamped to the range of coordinates.
    CoordBBox cells_around(const Bounds& box) const {
        openvdb::BBoxd reach;
        for (int corner = 0; corner < 8; ++corner)
            reach.expand(
                index_of({corner & 1 ? box.max.x : box.min.x, corner & 2 ? box.max.y : box.min.y,
                          corner & 4 ? box.max.z : box.min.z}));
        const auto cell = [](double x) { return int(std::clamp(x, -1e9, 1e9)); };
        Coord low, high;
        for (int a = 0; a < 3; ++a) {
            low[a] = cell(std::floor(reach.min()[a]) - 1);
            high[a] = cell(std::ceil(reach.max()[a]) + 1);
        }
        return {low, high};
    }

    FloatGrid::ConstPtr grid_;
    glm::dmat4 grid_from_world_;
    CoordBBox active_;
};

std::string names_of(const openvdb::GridPtrVec& grids) {
    std::string names;
    for (const openvdb::GridBase::Ptr& grid : grids)
        names += fmt::format("{}\"{}\"", names.empty() ? "" : ", ", grid->getName());
    return names.empty() ? "none" : names;
}

}  // namespace

void check_values(const FloatGrid& grid, const InputFile& file) {
    bool finite = std::isfinite(grid.background());
    for (auto value = grid.cbeginValueAll(); value && finite; ++value)
        finite = std::isfinite(*value);
    if (!finite)
        file.refuse(fmt::format("grid \"{}\" has a value that is no number", grid.getName()));
}

FloatGrid::Ptr density_in(const InputFile& file, const std::string& name) {
    const openvdb::GridPtrVecPtr grids = read_vdb_content(file).grids;
    for (const openvdb::GridBase::Ptr& grid : *grids) {
        if (grid->getName() != name) continue;
        auto floats = openvdb::gridPtrCast<FloatGrid>(grid);
        if (!floats)
            file.refuse(fmt::format("grid \"{}\" holds {} values; a density is of float values",
                                    name, grid->valueType()));
        if (!floats->transform().isLinear())
            file.refuse(
                fmt::format("grid \"{}\" is bent by its transform; only affine ones "
                            "can be placed",
                            name));
        check_values(*floats, file);
        return floats;
    }
    file.refuse(fmt::format("has no grid \"{}\"; its grids: {}", name, names_of(*grids)));
}

std::unique_ptr<DensityField> density_field_of(FloatGrid::ConstPtr grid,
                                               const glm::dmat4& world_from_grid) {
    return std::make_unique<VdbField>(std::move(grid), world_from_grid);
}

}  // namespace voxelume::vdb
