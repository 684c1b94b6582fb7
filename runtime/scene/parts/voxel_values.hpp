// SPDX-License-Identifier: Apache-2.0
// The choice of the values of a file's array that are voxels.
#pragma once

#include <optional>
#include <tuple>

namespace voxelume {

/// A scene's choice for a file of values. Without any, voxels are the whole numbers that aren't 0,
/// and other numbers from 0.5 on.
struct VoxelValues {
    std::optional<double> iso{};  ///< voxels have at least this value; a smooth surface has it
    std::optional<int> label{};   ///< voxels have this value
    bool each_label = false;      ///< all values but 0 are voxels, each in a colour of its own

    bool is_there() const { return iso || label || each_label; }
    friend bool operator<(const VoxelValues& a, const VoxelValues& b) {
        return std::tie(a.iso, a.label, a.each_label) < std::tie(b.iso, b.label, b.each_label);
    }
    friend bool operator==(const VoxelValues&, const VoxelValues&) = default;
};

}  // namespace voxelume
