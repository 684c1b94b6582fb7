// SPDX-License-Identifier: Apache-2.0
// Arrays of values or colours -> models: cubes, or the surface on which the values are equal.
#pragma once

#include <algorithm>
#include <cmath>
#include <map>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/arrays/cell_array.hpp"
#include "runtime/scene/parts/voxel_values.hpp"

namespace voxelume {

/// The cells with these values as cubes. If the array has colours, all cells that aren't black, or
/// with an opacity all that aren't clear. Throws Error::input for a file that is truncated or
/// damaged, for arrays without such cells, and for `values` that colours don't have.
VoxelModel cubes_of_array(const CellArray& array, const VoxelValues& values);

/// The surface between the cells with these values and the others. The field is linear in the
/// array's values: half-Taylor interpolation between the middles of cells is of third order. Beyond
/// the array's end its values are mirrored, so that the surface is closed there. Throws
/// Error::input as cubes_of_array does, and for colours and arrays of more than 2^30 cells, or 2^28
/// in gzip.
VoxelModel surface_of_array(const CellArray& array, const VoxelValues& values);

/// Statistics of the values of an array.
struct ArraySummary {
    double min = 0, max = 0;
    uint64_t not_finite = 0;
    uint64_t zeros = 0;
    /// The value that best separates the values into two sets, after Otsu 1979.
    double threshold = 0;
    /// Empty unless all values are whole numbers and few: then the number of cells with each value
    /// but 0.
    std::map<int, uint64_t> labels;
};

/// Reads all values once. Throws Error::input for a file that is truncated or damaged, and for
/// arrays of colours.
ArraySummary summary_of_array(const CellArray& array);

/// The largest of an array's colours, or the first one above `enough`, after which nothing more is
/// read. Throws Error::input as summary_of_array.
double largest_color(const CellArray& array, double enough);

/// True if an array's colours are masks: each channel is 0 or 1.
bool has_color_masks(const CellArray& array);

/// True if a value is a label: a whole number other than 0. Fractions, NaN and infinity are not.
inline bool is_label(double value) {
    return std::isfinite(value) && value != 0 && value == std::floor(value);
}

/// The number of a label, clamped to 32 bits.
inline int label_of(double value) {
    return int(std::clamp(value, -2147483648.0, 2147483647.0));
}

/// The colour of a label, 0xBBGGRR, which is equal in all files.
uint32_t label_color(int label);

}  // namespace voxelume
