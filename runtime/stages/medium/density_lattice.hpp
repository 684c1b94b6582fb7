// SPDX-License-Identifier: Apache-2.0
// The densities of a world's voxels, sampled brick by brick in main memory.
#pragma once

#include <glm/vec4.hpp>
#include <memory>
#include <optional>
#include <span>
#include <vector>

#include "runtime/grid/density_field.hpp"
#include "runtime/grid/grid.hpp"
#include "runtime/stages/medium/medium_light.hpp"
#include "runtime/stages/medium/transfer_curve.hpp"

namespace voxelume {

inline constexpr size_t kBrickCells = 4096;

class DensityLattice {
  public:
    /// `lights` light the scans that are lit by the scene; the lattice's size doesn't depend on
    /// them.
    explicit DensityLattice(const World& world, const std::vector<Light>& lights = {});

    const glm::ivec3& bricks() const { return bricks_; }
    const glm::ivec3& shift() const { return shift_; }
    size_t brick_count() const { return size_t(bricks_.x) * bricks_.y * bricks_.z; }
    double field_bytes() const;
    bool is_zero() const;
    bool has_colors() const { return !scans_.empty(); }

    /// The density of a brick if it is known to be constant; for a density with colours, only 0 is
    /// known.
    std::optional<float> constant_in(size_t number) const;
    /// `colors` has three numbers for each density, or is empty without colours.
    void sample(size_t number, std::span<float, kBrickCells> densities,
                std::span<float> colors) const;

  private:
    /// A scan with its transfer function; several may share one field.
    struct Scan {
        std::shared_ptr<const DensityField> field;
        TransferCurve curve;
        std::optional<MediumLights> lights;
    };

    void add_scan(const GridDensity& grid);
    glm::dvec3 first_corner(size_t number) const;
    bool is_empty_in(const Bounds& box) const;
    void add_means(const Scan& scan, size_t number, std::span<glm::dvec4> sums) const;
    void average(size_t number, std::span<float, kBrickCells> densities,
                 std::span<float> colors) const;

    MediumLights scene_lights_;
    std::shared_ptr<const DensityField> field_;  ///< field of a medium without transfer functions
    std::vector<Scan> scans_;
    std::vector<GridDensity> seen_;  ///< grids of the scans
    GridFrame frame_;
    glm::ivec3 bricks_{0}, shift_{0};
};

}  // namespace voxelume
