// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/density_source.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>

#include "runtime/base/error.hpp"
#include "runtime/io/arrays/array_density.hpp"
#include "runtime/io/vdb/vdb_density.hpp"
#include "runtime/io/voxel_file_table.hpp"

namespace voxelume {
namespace {

/// Calls `density` with each of 16³ points.
template <class Density>
void sample_points(const glm::dvec3& first, const glm::dvec3& step,
                   std::span<float, 4096> densities, const Density& density) {
    for (size_t i = 0; i < 4096; ++i)
        densities[i] = density(first + step * glm::dvec3(i & 15, i >> 4 & 15, i >> 8));
}

class HeightField : public DensityField {
  public:
    explicit HeightField(const HeightDensity& height) : height_(height) {}

    bool is_layered() const override { return true; }
    std::optional<float> constant_in(const Bounds& box) const override {
        const float lowest = at(box.min.y), highest = at(box.max.y);
        return lowest == highest ? std::optional(lowest) : std::nullopt;
    }
    void sample(const glm::dvec3& first, const glm::dvec3& step,
                std::span<float, 4096> densities) const override {
        for (size_t row = 0; row < 256; ++row)
            std::ranges::fill(densities.subspan(16 * row, 16),
                              at(first.y + step.y * double(row & 15)));
    }

  private:
    float at(double y) const {
        const auto density = float(std::exp((height_.base - y) / height_.scale_height));
        return std::isnormal(density) || y <= height_.base ? std::min(density, 1.0f) : 0.0f;
    }

    HeightDensity height_;
};

class BallField : public DensityField {
  public:
    explicit BallField(const BallDensity& ball) : ball_(ball) {}

    std::optional<float> constant_in(const Bounds& box) const override {
        const glm::dvec3 nearest = glm::clamp(ball_.center, box.min, box.max);
        if (glm::distance(nearest, ball_.center) > ball_.radius) return 0.0f;
        const glm::dvec3 reach =
            glm::max(glm::abs(box.min - ball_.center), glm::abs(box.max - ball_.center));
        if (glm::length(reach) <= ball_.radius - ball_.falloff) return 1.0f;
        return std::nullopt;
    }
    void sample(const glm::dvec3& first, const glm::dvec3& step,
                std::span<float, 4096> densities) const override {
        sample_points(first, step, densities, [this](const glm::dvec3& p) { return at(p); });
    }

  private:
    float at(const glm::dvec3& p) const {
        const double inside = ball_.radius - glm::distance(p, ball_.center);
        if (inside >= ball_.falloff) return 1;
        if (inside <= 0) return 0;
        const double s = inside / ball_.falloff;
        return float(s * s * (3 - 2 * s));
    }

    BallDensity ball_;
};

}  // namespace

std::unique_ptr<DensityField> density_field(const Medium& medium) {
    if (const auto* height = std::get_if<HeightDensity>(&medium.density))
        return std::make_unique<HeightField>(*height);
    if (const auto* ball = std::get_if<BallDensity>(&medium.density))
        return std::make_unique<BallField>(*ball);
    return grid_field(std::get<GridDensity>(medium.density));
}

std::unique_ptr<DensityField> grid_field(const GridDensity& grid) {
    try {
        const VoxelFileFormat* const format = voxel_format_named(grid.file);
        if (format && format->array)
            return read_array_density(format->array(grid.file), grid.world_from_grid);
        return read_vdb_density(grid);
    } catch (const Error& error) {
        throw Error(error.kind(), "{}: {}", grid.where, error.what());
    }
}

}  // namespace voxelume
