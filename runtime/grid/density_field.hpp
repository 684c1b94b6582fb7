// SPDX-License-Identifier: Apache-2.0
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

    /// True if the density depends on y alone.
    virtual bool is_layered() const { return false; }

    /// The density in a whole box in metres, if it is known to be constant there.
    virtual std::optional<float> constant_in(const Bounds& box) const = 0;

    /// The densities at first + step * (i, j, k) for i, j, k = 0 .. 15, metres, x fastest.
    virtual void sample(const glm::dvec3& first, const glm::dvec3& step,
                        std::span<float, 4096> densities) const = 0;

    /// True if the density is known to be 0 everywhere.
    virtual bool is_zero() const { return false; }

    /// The main memory that the field takes, in bytes.
    virtual double bytes() const { return 0; }
};

}  // namespace voxelume
