// The cells that a ray passes, in order, in integers: what the device's walk is held against.
// Shares no code with the kernels.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace voxelume {

/// A grid and the fixed point of rays through it: integer bits of the longest side and
/// `fraction_bits` are 24 together. So places are below 2^24 units whatever the grid's size, up to
/// the 65,536 voxels of the largest worlds, products with directions below 2^47, and 64 bits are
/// enough for all of it.
struct FixedGrid {
    glm::ivec3 size{0};  ///< voxels
    int fraction_bits = 0;

    int64_t unit() const { return int64_t{1} << fraction_bits; }
};

/// The fixed point that grids of this size have.
FixedGrid fixed_grid(const glm::ivec3& size);

inline constexpr int64_t kDirectionOne = int64_t{1} << 22;  ///< a direction's component of 1

/// A ray in fixed point: the origin in 2^-fraction_bits voxels, in the grid, the direction in 2^-22
/// with the largest component from 2^21 to 2^22.
struct FixedRay {
    std::array<int64_t, 3> origin{}, direction{};
};

/// What of a walk is compared: how many cells were entered, and a number that depends on each of
/// them, on the axis and the t of each crossing, to the bit, and on their order.
struct WalkDigest {
    uint32_t cells = 0, hash = 0;

    friend bool operator==(const WalkDigest&, const WalkDigest&) = default;
};

/// A cell that a walk enters.
struct EnteredCell {
    glm::ivec3 cell{0};
    int axis = 3;  ///< across which; 3: the ray began there
    float t = 0;   ///< when: (plane - origin) times 1 / direction, each rounded once

    friend bool operator==(const EnteredCell&, const EnteredCell&) = default;
};

/// How far a walk steps.
enum class Steps {
    cells,   ///< from cell to cell
    blocks,  ///< out of aligned blocks of 1 to 64 cells, whose edges `block_log2` chooses
};

/// The edge, as a power of two, of the block around a cell that is left in one step.
int block_log2(const glm::ivec3& cell);

/// The digest of the first `maximum` cells of a ray's walk. A point on a plane belongs to the cell
/// being entered; crossings at one t are taken lowest axis first.
WalkDigest exact_digest(const FixedGrid& grid, const FixedRay& ray, Steps steps, uint32_t maximum);

/// The cells themselves.
std::vector<EnteredCell> exact_cells(const FixedGrid& grid, const FixedRay& ray, Steps steps,
                                     uint32_t maximum);

/// Voxels of a grid, one bit each, x fastest.
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

/// The first cell of `voxels` that a ray enters; false when there is none.
bool exact_first_hit(const FixedGrid& grid, const FixedRay& ray, const VoxelBits& voxels,
                     EnteredCell& hit);

}  // namespace voxelume
