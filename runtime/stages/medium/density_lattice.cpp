// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/density_lattice.hpp"

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/grid/world_frame.hpp"
#include "runtime/stages/medium/density_source.hpp"

namespace voxelume {
namespace {

/// log2 of the cell's extent along an axis along which nothing changes: the whole axis is one cell.
constexpr int kWholeAxis = 16;

/// Points of a brick's half voxels along an axis, with both ends.
constexpr int kPoints = 2 * kBrickSize + 1;

std::optional<TransferCurve> curve_of(const Medium& medium) {
    if (!has_medium_colors(medium)) return {};
    return TransferCurve(std::get<GridDensity>(medium.density).transfer);
}

/// The light on a voxel whose eighths have such absorptions, from a light that travels along a unit
/// vector: as on a surface, as far as the absorption rises from one side of the voxel to the other.
double light_on(const std::array<double, 8>& eighths, const glm::dvec3& edge,
                const glm::dvec3& lit) {
    constexpr double kShadow = 0.25;  // what the side away from the light shows
    glm::dvec3 rise(0);
    double sum = 0;
    for (size_t i = 0; i < 8; ++i) {
        sum += eighths[i];
        for (int axis = 0; axis < 3; ++axis)
            rise[axis] += (i >> axis & 1) != 0 ? eighths[i] : -eighths[i];
    }
    const double contrast = glm::length(rise);
    if (!(contrast > 0)) return 1;
    const glm::dvec3 inward = glm::normalize(rise / edge);
    const double shown = kShadow + (1 - kShadow) * std::max(glm::dot(inward, lit), 0.0);
    // A difference of a quarter of the mean is a surface; smaller ones are parts of one.
    return glm::mix(1.0, shown, std::min(4 * contrast / sum, 1.0));
}

}  // namespace

DensityLattice::DensityLattice(const World& world)
    : field_(density_field(world.medium)),
      curve_(curve_of(world.medium)),
      frame_(world_frame(world)) {
    if (curve_) lit_ = std::get<GridDensity>(world.medium.density).lit;
    if (field_->is_layered()) {
        shift_ = {kWholeAxis, 0, kWholeAxis};
        frame_.voxel_edge *= glm::dvec3(frame_.size.x, 1, frame_.size.z);
        frame_.size = {1, frame_.size.y, 1};
    }
    bricks_ = (frame_.size + kBrickSize - 1) / kBrickSize;
}

bool DensityLattice::is_zero() const {
    if (!curve_ && field_->is_zero()) return true;
    for (size_t number = 0; number < brick_count(); ++number)
        if (constant_in(number) != 0.0f) return false;
    return true;
}

std::optional<float> DensityLattice::constant_in(size_t number) const {
    const glm::dvec3 first = first_corner(number);
    if (curve_) {
        const ValueRange range =
            field_->range_in({first, first + frame_.voxel_edge * double(kBrickSize)});
        const bool is_empty = range.min > range.max || curve_->is_zero_in(range.min, range.max);
        return is_empty ? std::optional(0.0f) : std::nullopt;
    }
    const glm::dvec3 center = first + frame_.voxel_edge * 0.5;
    return field_->constant_in({center, center + frame_.voxel_edge * double(kBrickSize - 1)});
}

void DensityLattice::sample(size_t number, std::span<float, kBrickCells> densities,
                            std::span<float> colors) const {
    if (curve_) return average(number, densities, colors);
    field_->sample(first_corner(number) + frame_.voxel_edge * 0.5, frame_.voxel_edge, densities);
}

/// Each voxel has the mean of its eight halves' halves, whose values are taken for linear. So it is
/// exact for a scan whose cells are as large as voxels and lie where they do.
void DensityLattice::average(size_t number, std::span<float, kBrickCells> densities,
                             std::span<float> colors) const {
    std::vector<float> values(size_t(kPoints) * kPoints * kPoints);
    field_->sample_values(first_corner(number), frame_.voxel_edge * 0.5, glm::ivec3(kPoints),
                          values);
    const auto part_at = [&](int x, int y, int z) {
        std::array<float, 8> corners{};
        for (int c = 0; c < 8; ++c)
            corners[size_t(c)] =
                values[(size_t(z + (c >> 2)) * kPoints + size_t(y + (c >> 1 & 1))) * kPoints +
                       size_t(x + (c & 1))];
        return curve_->mean(corners);
    };
    for (int cell = 0; cell < int(kBrickCells); ++cell) {
        const int x = 2 * (cell & 15), y = 2 * (cell >> 4 & 15), z = 2 * (cell >> 8);
        glm::dvec4 sum(0);
        std::array<double, 8> absorptions{};
        for (int part = 0; part < 8; ++part) {
            const glm::dvec4 mean = part_at(x + (part & 1), y + (part >> 1 & 1), z + (part >> 2));
            absorptions[size_t(part)] = mean.w;
            sum += mean;
        }
        densities[size_t(cell)] = float(sum.w / 8);
        const double light = lit_ != glm::dvec3(0) && sum.w > 0
                                 ? light_on(absorptions, frame_.voxel_edge, lit_)
                                 : 1.0;
        for (int c = 0; c < 3; ++c)
            colors[3 * size_t(cell) + size_t(c)] = sum.w > 0 ? float(light * sum[c] / sum.w) : 0.0f;
    }
}

glm::dvec3 DensityLattice::first_corner(size_t number) const {
    const glm::ivec3 brick(number % bricks_.x, number / bricks_.x % bricks_.y,
                           number / bricks_.x / bricks_.y);
    return frame_.origin + frame_.voxel_edge * glm::dvec3(brick * kBrickSize);
}

}  // namespace voxelume
