// SPDX-License-Identifier: Apache-2.0
// Numbers at chosen frames, and the values between them.
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace voxelume {

/// The value between two keys.
enum class Interpolation : uint8_t {
    step,    ///< the earlier key's value
    linear,  ///< number by number
    cubic,   ///< number by number, with a continuous speed and never beyond the keys on both sides
    slerp,   ///< for turns: about one axis, at an even speed, the shorter way round
    spline   ///< number by number, with the slopes that the keys have; quaternions are normalized
};

/// Rows of numbers at frames.
struct Keyframes {
    Interpolation interpolation = Interpolation::linear;
    std::vector<double> frames;  ///< ascending, no two alike, at least one
    std::vector<double>
        values;  ///< `width` numbers per frame; of slerp 3 angles in degrees, a turn
    size_t width = 1;
    /// Splines have slopes per frame before and after each key, laid out as `values` are.
    std::vector<double> in = {}, out = {};
    /// Rows are quaternions [x, y, z, w] of turns, for which values_at() gives three angles.
    bool has_quaternions = false;
};

/// Number of the last key at or before a frame; 0 before the first.
size_t key_before(const std::vector<double>& frames, double frame);

/// The row of numbers at a frame. Frames before the first key have its row, and frames after the
/// last key have the last one's.
///
/// Cubic is a Hermite spline that is at rest at the first and the last key and wherever a number
/// turns back; elsewhere its slope is the weighted harmonic mean of the slopes on both sides, which
/// keeps it monotone between keys (Fritsch & Butland 1984). At a key the row is the key's own, bit
/// by bit, unless it is a quaternion.
std::vector<double> values_at(const Keyframes& keys, double frame);

}  // namespace voxelume
