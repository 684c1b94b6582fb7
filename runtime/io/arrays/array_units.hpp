// SPDX-License-Identifier: Apache-2.0
// value of a cell -> the distance that a node of a smooth surface stores
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/arrays/array_sides.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

inline constexpr int16_t kMaxUnits = 32767;  ///< distance stored far outside

/// Distances in which the steepest step through the surface is a voxel long.
class ArrayUnits {
  public:
    ArrayUnits(const SurfaceValues& values, float steepest, CellType type)
        : values_(values), steepest_(steepest) {
        // 512^3 bytes close to a surface take a third of the time that way.
        if (bytes_of(type) == 1)
            for (int byte = 0; byte < 256; ++byte)
                of_bytes_[size_t(byte)] =
                    units(values.step(type == CellType::i8 ? int(int8_t(byte)) : byte));
    }

    template <class Value>
    int16_t operator()(Value value) const {
        if constexpr (sizeof(Value) == 1)
            return of_bytes_[uint8_t(value)];
        else
            return units(values_.step(value));
    }

  private:
    int16_t units(float step) const {
        if (!std::isfinite(step)) return int16_t(step < 0 ? -kMaxUnits : kMaxUnits);
        const float units = std::clamp(step / steepest_ * float(kDistanceUnitsPerVoxel),
                                       -float(kMaxUnits), float(kMaxUnits));
        // Rounds as std::lround() does: the sum of a float and a half is exact as a double.
        return int16_t(double(units) + (units < 0 ? -0.5 : 0.5));
    }

    const SurfaceValues& values_;
    float steepest_;
    std::array<int16_t, 256> of_bytes_{};
};

}  // namespace voxelume
