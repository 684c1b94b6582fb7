// SPDX-License-Identifier: Apache-2.0
// array -> which of its cells lie inside a surface, and where neighbours lie on both sides of it.
#pragma once

#include "runtime/base/files/input_file.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/arrays/cell_bits.hpp"

namespace voxelume {

/// What a surface parts: one label or all values but 0 from the rest, or the values above another
/// one from the others.
class SurfaceValues {
  public:
    SurfaceValues(const CellArray& array, const VoxelValues& values);

    /// What choose() takes for the inside of the surface.
    const VoxelValues& inside() const { return inside_; }

    /// How far the value of a cell, as the file has it, is below what is looked for; negative
    /// inside. 1 / 2 or -1 / 2 in a set.
    template <class Value>
    float step(Value value) const {
        const double v = slope_ * double(value) + intercept_;
        if (iso_) return step_between(*iso_, v);
        return inside_.label ? (v == *inside_.label ? -0.5f : 0.5f) : (v != 0 ? -0.5f : 0.5f);
    }
    /// How far a value is below another one. Infinity stays what it is.
    static float step_between(double high, double low);

    /// True if values of some cells may be so large, or no numbers, that no surface is near them.
    bool may_be_infinite() const { return may_be_infinite_; }

    /// False where no value from `min` to `max` lies inside.
    bool are_crossed(double min, double max) const;
    /// What is looked for, such as `the label 3`.
    std::string in_words() const;

  private:
    double slope_, intercept_;
    std::optional<double> iso_;
    VoxelValues inside_;
    bool may_be_infinite_;
};

struct ArraySides {
    CellBits inside;
    CellBits finite;  ///< without cells where all are
    double min = 0, max = 0;

    /// One row of the pairs of neighbours with the surface between them: of each cell at (x, y, z)
    /// and its next one along the file's axis. `out` has the words of a row.
    void pairs(int axis, int y, int z, uint64_t* out) const;

    glm::ivec3 counts{0};
};

/// Reads all values once. Throws Error::input for a file that is truncated or damaged.
ArraySides sides_of_array(const CellArray& array, const InputFile& file,
                          const SurfaceValues& values);

}  // namespace voxelume
