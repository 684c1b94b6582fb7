// The density of a medium anywhere in the world, before it is sampled at voxels.
#pragma once

#include <optional>
#include <span>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// Densities are finite and >= 0.
class DensityField {
  public:
    virtual ~DensityField() = default;

    /// Whether the density depends on y alone.
    virtual bool is_layered() const { return false; }

    /// The density all over a box in metres, where that is known to be one.
    virtual std::optional<float> constant_in(const Bounds& box) const = 0;

    /// The densities at first + step * (i, j, k) for i, j, k = 0 .. 15, metres, x fastest.
    virtual void sample(const glm::dvec3& first, const glm::dvec3& step,
                        std::span<float, 4096> densities) const = 0;

    /// Whether it is known to be 0 everywhere.
    virtual bool is_zero() const { return false; }

    /// Main memory that it takes.
    virtual double bytes() const { return 0; }
};

}  // namespace voxelume
