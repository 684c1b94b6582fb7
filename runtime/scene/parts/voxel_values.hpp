// SPDX-License-Identifier: Apache-2.0
// Which values of a file's array are voxels.
#pragma once

#include <optional>
#include <tuple>

namespace voxelume {

/// What a scene says of a file of values. Without any, voxels are the whole numbers that aren't 0,
/// and the other numbers from 0.5 on.
struct VoxelValues {
    std::optional<double> iso{};  ///< voxels have this value or more; where a smooth surface runs
    std::optional<int> label{};   ///< voxels have this value
    bool each_label = false;      ///< all values but 0, each in a colour of its own

    bool is_there() const { return iso || label || each_label; }
    friend bool operator<(const VoxelValues& a, const VoxelValues& b) {
        return std::tie(a.iso, a.label, a.each_label) < std::tie(b.iso, b.label, b.each_label);
    }
    friend bool operator==(const VoxelValues&, const VoxelValues&) = default;
};

}  // namespace voxelume
