// SPDX-License-Identifier: Apache-2.0
// The densities of a world's voxels, sampled brick by brick in main memory.
#pragma once

#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/grid/density_field.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/stages/medium/transfer_curve.hpp"

namespace voxelume {

inline constexpr size_t kBrickCells = 4096;

class DensityLattice {
  public:
    explicit DensityLattice(const World& world);

    const glm::ivec3& bricks() const { return bricks_; }
    const glm::ivec3& shift() const { return shift_; }
    size_t brick_count() const { return size_t(bricks_.x) * bricks_.y * bricks_.z; }
    double field_bytes() const { return field_->bytes(); }
    bool is_zero() const;
    bool has_colors() const { return curve_.has_value(); }

    /// The density of a brick where it is known to be constant; of one with colours only 0.
    std::optional<float> constant_in(size_t number) const;
    /// `colors` has three numbers for each density, or is empty without colours.
    void sample(size_t number, std::span<float, kBrickCells> densities,
                std::span<float> colors) const;

  private:
    glm::dvec3 first_corner(size_t number) const;
    void average(size_t number, std::span<float, kBrickCells> densities,
                 std::span<float> colors) const;

    std::unique_ptr<DensityField> field_;
    std::optional<TransferCurve> curve_;
    glm::dvec3 lit_{0};
    GridFrame frame_;
    glm::ivec3 bricks_{0}, shift_{0};
};

}  // namespace voxelume
