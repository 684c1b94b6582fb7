// SPDX-License-Identifier: Apache-2.0
// The density of a medium anywhere in the world, before it is sampled at voxels.
#pragma once

#include <algorithm>
#include <array>
#include <glm/common.hpp>
#include <limits>
#include <optional>
#include <span>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The value of a scan at points where it has none.
inline constexpr float kOutsideScan = -std::numeric_limits<float>::max();

/// The values in a box; none where `min` is above `max`.
struct ValueRange {
    double min = 0, max = 0;
    bool reaches_out = false;  ///< there are points without a value
};

/// The density of a medium: finite and >= 0. A scan also has values, which may be below 0;
/// elsewhere the values are the densities.
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

    /// A range that contains all values in a box in metres.
    virtual ValueRange range_in(const Bounds& box) const {
        const std::optional<float> constant = constant_in(box);
        if (constant) return {double(*constant), double(*constant)};
        return {-std::numeric_limits<double>::infinity(), std::numeric_limits<double>::infinity()};
    }

    /// The values at first + step * (i, j, k) for i, j, k below `count`, metres, x fastest;
    /// kOutsideScan where there is none.
    virtual void sample_values(const glm::dvec3& first, const glm::dvec3& step,
                               const glm::ivec3& count, std::span<float> values) const;

    /// True if the density is known to be 0 everywhere.
    virtual bool is_zero() const { return false; }

    /// The main memory that the field takes, in bytes.
    virtual double bytes() const { return 0; }
};

inline void DensityField::sample_values(const glm::dvec3& first, const glm::dvec3& step,
                                        const glm::ivec3& count, std::span<float> values) const {
    constexpr int kEdge = 16;
    std::array<float, 4096> block{};
    for (int z = 0; z < count.z; z += kEdge)
        for (int y = 0; y < count.y; y += kEdge)
            for (int x = 0; x < count.x; x += kEdge) {
                sample(first + step * glm::dvec3(x, y, z), step, block);
                const glm::ivec3 end = glm::min(count - glm::ivec3(x, y, z), glm::ivec3(kEdge));
                for (int k = 0; k < end.z; ++k)
                    for (int j = 0; j < end.y; ++j)
                        std::copy_n(&block[size_t(k * kEdge + j) * kEdge], end.x,
                                    &values[(size_t(z + k) * size_t(count.y) + size_t(y + j)) *
                                                size_t(count.x) +
                                            size_t(x)]);
            }
}

}  // namespace voxelume
