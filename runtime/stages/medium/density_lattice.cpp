// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/density_lattice.hpp"

#include <algorithm>
#include <array>

#include "runtime/grid/world_frame.hpp"
#include "runtime/stages/medium/density_source.hpp"

namespace voxelume {
namespace {

/// log2 of a cell's extent along an axis of constant density: the whole axis is one cell.
constexpr int kWholeAxis = 16;

/// The number of points along an axis of a brick's half voxels, including both ends.
constexpr int kPoints = 2 * kBrickSize + 1;

}  // namespace

DensityLattice::DensityLattice(const World& world, const std::vector<Light>& lights)
    : scene_lights_{lights, world.ambient}, frame_(world_frame(world)) {
    if (has_medium_colors(world.medium)) {
        const auto& first = std::get<GridDensity>(world.medium.density);
        add_scan(first);
        for (const GridDensity& other : first.others) add_scan(other);
    } else {
        field_ = density_field(world.medium);
    }
    if (field_ && field_->is_layered()) {
        shift_ = {kWholeAxis, 0, kWholeAxis};
        frame_.voxel_edge *= glm::dvec3(frame_.size.x, 1, frame_.size.z);
        frame_.size = {1, frame_.size.y, 1};
    }
    bricks_ = (frame_.size + kBrickSize - 1) / kBrickSize;
}

/// Adds a scan. Windows of one scan share its values.
void DensityLattice::add_scan(const GridDensity& grid) {
    const auto same = std::ranges::find_if(seen_, [&](const GridDensity& known) {
        return known.file == grid.file && known.grid == grid.grid &&
               known.world_from_grid == grid.world_from_grid;
    });
    std::shared_ptr<const DensityField> field;
    if (same != seen_.end())
        field = scans_[size_t(same - seen_.begin())].field;
    else
        field = grid_field(grid);
    seen_.push_back(grid);
    Scan scan{std::move(field), TransferCurve(grid.transfer), {}};
    if (grid.is_lit_by_scene)
        scan.lights = scene_lights_;
    else if (grid.lit != glm::dvec3(0))
        scan.lights = lights_along(grid.lit);
    scans_.push_back(std::move(scan));
}

double DensityLattice::field_bytes() const {
    if (field_) return field_->bytes();
    double bytes = 0;
    for (size_t i = 0; i < scans_.size(); ++i) {
        const auto is_same = [&](const Scan& other) { return other.field == scans_[i].field; };
        if (std::none_of(scans_.begin(), scans_.begin() + std::ptrdiff_t(i), is_same))
            bytes += scans_[i].field->bytes();
    }
    return bytes;
}

bool DensityLattice::is_zero() const {
    if (field_ && field_->is_zero()) return true;
    for (size_t number = 0; number < brick_count(); ++number)
        if (constant_in(number) != 0.0f) return false;
    return true;
}

/// True if all scans are known to be empty in a box.
bool DensityLattice::is_empty_in(const Bounds& box) const {
    return std::ranges::all_of(scans_, [&](const Scan& scan) {
        const ValueRange range = scan.field->range_in(box);
        return range.min > range.max || scan.curve.is_zero_in(range.min, range.max);
    });
}

std::optional<float> DensityLattice::constant_in(size_t number) const {
    const glm::dvec3 first = first_corner(number);
    if (has_colors())
        return is_empty_in({first, first + frame_.voxel_edge * double(kBrickSize)})
                   ? std::optional(0.0f)
                   : std::nullopt;
    const glm::dvec3 center = first + frame_.voxel_edge * 0.5;
    return field_->constant_in({center, center + frame_.voxel_edge * double(kBrickSize - 1)});
}

void DensityLattice::sample(size_t number, std::span<float, kBrickCells> densities,
                            std::span<float> colors) const {
    if (has_colors()) return average(number, densities, colors);
    field_->sample(first_corner(number) + frame_.voxel_edge * 0.5, frame_.voxel_edge, densities);
}

/// Adds absorption times colour, and absorption, of a scan in the voxels of a brick. Each voxel has
/// the mean over its half voxels, in which values are interpolated linearly. So the mean is exact
/// for a scan whose cells coincide with voxels.
void DensityLattice::add_means(const Scan& scan, size_t number, std::span<glm::dvec4> sums) const {
    std::vector<float> values(size_t(kPoints) * kPoints * kPoints);
    scan.field->sample_values(first_corner(number), frame_.voxel_edge * 0.5, glm::ivec3(kPoints),
                              values);
    const auto part_at = [&](int x, int y, int z) {
        std::array<float, 8> corners{};
        for (int c = 0; c < 8; ++c)
            corners[size_t(c)] =
                values[(size_t(z + (c >> 2)) * kPoints + size_t(y + (c >> 1 & 1))) * kPoints +
                       size_t(x + (c & 1))];
        return scan.curve.mean(corners);
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
        glm::dvec3 light(1);
        if (scan.lights && sum.w > 0) {
            const glm::dvec3 middle = 0.5 * glm::dvec3(x + 1, y + 1, z + 1);
            light = light_on(medium_surface(absorptions, frame_.voxel_edge),
                             first_corner(number) + frame_.voxel_edge * middle, *scan.lights);
        }
        sums[size_t(cell)] += glm::dvec4(light * glm::dvec3(sum), sum.w);
    }
}

/// Combines all scans: their absorptions add up, and so do the products with their colours.
void DensityLattice::average(size_t number, std::span<float, kBrickCells> densities,
                             std::span<float> colors) const {
    std::vector<glm::dvec4> sums(kBrickCells, glm::dvec4(0));
    for (const Scan& scan : scans_) add_means(scan, number, sums);
    for (size_t cell = 0; cell < kBrickCells; ++cell) {
        const glm::dvec4& sum = sums[cell];
        densities[cell] = float(sum.w / 8);
        for (int c = 0; c < 3; ++c)
            colors[3 * cell + size_t(c)] = sum.w > 0 ? float(sum[c] / sum.w) : 0.0f;
    }
}

glm::dvec3 DensityLattice::first_corner(size_t number) const {
    const glm::ivec3 brick(number % bricks_.x, number / bricks_.x % bricks_.y,
                           number / bricks_.x / bricks_.y);
    return frame_.origin + frame_.voxel_edge * glm::dvec3(brick * kBrickSize);
}

}  // namespace voxelume
