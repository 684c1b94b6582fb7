// SPDX-License-Identifier: Apache-2.0
// array -> the cells that lie inside a surface, and the neighbours that lie on both sides of it.
#pragma once

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/arrays/cell_bits.hpp"

namespace voxelume {

/// The values inside a surface: one label, all values but 0, or the values above another one.
class SurfaceValues {
  public:
    SurfaceValues(const CellArray& array, const VoxelValues& values);

    /// The values that choose() selects as the inside of the surface.
    const VoxelValues& inside() const { return inside_; }

    /// The signed distance of a cell's value, as the file stores it, below the surface's value;
    /// negative inside. In a set it is 1 / 2 or -1 / 2.
    template <class Value>
    float step(Value value) const {
        const double v = slope_ * double(value) + intercept_;
        if (iso_) return step_between(*iso_, v);
        return inside_.label ? (v == *inside_.label ? -0.5f : 0.5f) : (v != 0 ? -0.5f : 0.5f);
    }
    /// The difference of two values. Infinity stays infinite.
    static float step_between(double high, double low);

    /// True if some values may be infinite or NaN, so that no surface is near them.
    bool may_be_infinite() const { return may_be_infinite_; }

    /// False where no value from `min` to `max` lies inside.
    bool are_crossed(double min, double max) const;
    /// The values inside in words, such as `the label 3`.
    std::string in_words() const;

  private:
    double slope_, intercept_;
    std::optional<double> iso_;
    VoxelValues inside_;
    bool may_be_infinite_;
};

struct ArraySides {
    CellBits inside;
    CellBits finite;  ///< cells with finite values; empty if all have them
    double min = 0, max = 0;

    /// Writes one row of bits: bit x is set if the surface lies between cell (x, y, z) and its next
    /// one along the file's axis. `out` has the words of a row.
    void pairs(int axis, int y, int z, uint64_t* out) const;

    glm::ivec3 counts{0};
};

/// Reads all values once. Throws Error::input for a file that is truncated or damaged.
ArraySides sides_of_array(const CellArray& array, const InputFile& file,
                          const SurfaceValues& values);

}  // namespace voxelume
