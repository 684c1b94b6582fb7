// SPDX-License-Identifier: Apache-2.0
// The cells that a ray passes, in order, in integers: the reference for the device's walk. It
// shares no code with the kernels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace voxelume {

/// A grid and the fixed point of rays through it. The integer bits of the longest side and
/// `fraction_bits` are 24 together. So coordinates are below 2^24 units whatever the grid's size,
/// up to the 65,536 voxels of the largest worlds. Products with directions are below 2^47, and 64
/// bits are enough for all of it.
struct FixedGrid {
    glm::ivec3 size{0};  ///< voxels
    int fraction_bits = 0;

    int64_t unit() const { return int64_t{1} << fraction_bits; }
};

/// The fixed point of grids of this size.
FixedGrid fixed_grid(const glm::ivec3& size);

inline constexpr int64_t kDirectionOne = int64_t{1} << 22;  ///< a direction's component of 1

/// A ray in fixed point. The origin is in 2^-fraction_bits voxels and lies in the grid. The
/// direction is in 2^-22; its largest component is between 2^21 and 2^22.
struct FixedRay {
    std::array<int64_t, 3> origin{}, direction{};
};

/// The parts of a walk that are compared: the number of cells entered, and a hash. The hash depends
/// on each cell, on the axis and, to the bit, the t of each crossing, and on their order.
struct WalkDigest {
    uint32_t cells = 0, hash = 0;

    friend bool operator==(const WalkDigest&, const WalkDigest&) = default;
};

/// A cell that a walk enters.
struct EnteredCell {
    glm::ivec3 cell{0};
    int axis = 3;  ///< axis of the crossing; 3: the ray began in the cell
    float t = 0;   ///< (plane - origin) times 1 / direction, each rounded once

    friend bool operator==(const EnteredCell&, const EnteredCell&) = default;
};

/// The steps of a walk.
enum class Steps {
    cells,   ///< from cell to cell
    blocks,  ///< out of aligned blocks of 1 to 64 cells; `block_log2` chooses their edges
};

/// The edge, as a power of two, of the block around a cell that a ray leaves in one step.
int block_log2(const glm::ivec3& cell);

/// The digest of the first `maximum` cells of a ray's walk. A point on a plane belongs to the cell
/// being entered. Crossings at one t are taken in the order of their axes.
WalkDigest exact_digest(const FixedGrid& grid, const FixedRay& ray, Steps steps, uint32_t maximum);

/// The first `maximum` cells themselves.
std::vector<EnteredCell> exact_cells(const FixedGrid& grid, const FixedRay& ray, Steps steps,
                                     uint32_t maximum);

/// The voxels of a grid, one bit each, x fastest.
class VoxelBits {
  public:
    explicit VoxelBits(const glm::ivec3& size)
        : size_(size), words_((size_t(size.x) * size_t(size.y) * size_t(size.z) + 63) / 64) {}

    void set(const glm::ivec3& v) { words_[index(v) / 64] |= uint64_t{1} << index(v) % 64; }
    bool is_set(const glm::ivec3& v) const { return words_[index(v) / 64] >> index(v) % 64 & 1; }
    const glm::ivec3& size() const { return size_; }

  private:
    size_t index(const glm::ivec3& v) const {
        return size_t(v.x) + size_t(size_.x) * (size_t(v.y) + size_t(size_.y) * size_t(v.z));
    }
    glm::ivec3 size_;
    std::vector<uint64_t> words_;
};

/// Finds the first cell of `voxels` that a ray enters. Returns false if there is none.
bool exact_first_hit(const FixedGrid& grid, const FixedRay& ray, const VoxelBits& voxels,
                     EnteredCell& hit);

}  // namespace voxelume
