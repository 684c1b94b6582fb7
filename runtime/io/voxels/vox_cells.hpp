// SPDX-License-Identifier: Apache-2.0
// Voxels of a .vox file -> cells of palette indices, brick by brick.
#pragma once

#include <array>
#include <cstdint>
#include <vector>

#include "runtime/geometry/voxel_model.hpp"
#include "runtime/io/voxels/vox_file.hpp"

namespace voxelume {

/// A model with its placement, in the file's coordinates.
struct VoxStanding {
    const VoxModel* model;
    VoxRotation rotation;
    glm::ivec3 translation;
};

/// The turn from the axes of files, with Z up, to Y up.
inline const VoxRotation kVoxYUp{{0, 2, 1}, {1, 1, -1}};

struct CellBox {
    glm::ivec3 low{1 << 30}, high{-(1 << 30)};  ///< `high` is one past the last
};

/// The cells that a model may fill, with Y up.
CellBox box_of(const VoxStanding& standing);

/// Cells where some model may have voxels.
class VoxCells {
  public:
    /// Throws Error::input for a box that spans more than a model may.
    VoxCells(const CellBox& box, const InputFile& file);

    /// Makes room for a box of cells. Throws Error::input for more bricks than a model may have.
    void add_box(const CellBox& box);
    void allocate();

    /// Sets the cells of a model's voxels to their palette indices. Throws Error::input for voxels
    /// outside of their model.
    void add_voxels(const VoxStanding& standing);

    /// Moves the result into the model: palette indices as codes of colours, and groups.
    void fill(const std::array<uint32_t, 256>& groups, bool has_groups, VoxelModel& model) &&;

    /// For each palette index, whether some cell has it.
    std::array<bool, 256> used() const;

  private:
    /// The part that a coordinate of a model's voxel adds to the index of its cell.
    struct Step {
        uint32_t brick = 0, cell = 0;
    };
    /// Tables by axis of the model. A cell's index is the sum of the steps of three coordinates.
    struct Steps {
        std::array<std::array<Step, 256>, 3> of;
        std::array<int, 3> stride{};  ///< from cell to cell in a brick, negative if mirrored

        /// The number of cells in a row of one brick, from a coordinate on, up or down the axis.
        size_t room(size_t axis, uint32_t coordinate, bool is_up) const;
    };
    Steps steps_of(const VoxStanding& standing) const;
    /// Adds the voxels from number `first` to one before `end`. Returns how many have a colour.
    size_t add_range(const VoxModel& model, const Steps& steps, size_t first, size_t end);
    size_t add_block(const std::vector<uint32_t>& block, size_t count, const Steps& steps,
                     const glm::ivec3& size);
    /// Fills leaves_. Returns how many cells have a voxel.
    size_t mark_all();
    bool lies_in_rows(const VoxModel& model) const;
    /// Adds voxels in several threads. Returns false, with all cells as they were, where some
    /// voxels share a cell.
    bool add_together(const VoxModel& model, const Steps& steps);

    const InputFile& file_;
    GridFrame frame_;
    glm::ivec3 first_{0};
    std::vector<uint32_t> numbers_;  ///< by brick: index into cells_
    uint32_t count_ = 0;
    UnfilledVector<uint8_t> cells_;
    std::vector<uint64_t> leaves_;  ///< bits of cells_, while they are up to date
    bool is_untouched_ = true;      ///< no voxel has been added
};

}  // namespace voxelume
