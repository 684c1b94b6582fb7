// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/arrays/array_density.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/matrix.hpp>

#include "runtime/base/main_memory.hpp"
#include "runtime/io/arrays/array_stream.hpp"

namespace voxelume {
namespace {

constexpr uint64_t kMaxDensityCells = uint64_t{1} << 28;
constexpr int kBlockEdge = 8;  // cells along the edge of a block whose range is known

/// The smallest and the largest of some values; none where `min` is above `max`.
struct Extremes {
    float min = INFINITY, max = -INFINITY;
    bool has_gaps = false;  ///< some are missing

    void add(float value) {
        has_gaps |= value == kOutsideScan;
        if (value == kOutsideScan) return;
        min = std::min(min, value);
        max = std::max(max, value);
    }
};

/// Throws Error::limit where the values don't fit, before they are read.
void check_room(const CellArray& array, const InputFile& file) {
    const double bytes = double(array.cells()) * sizeof(float), there = double(main_memory());
    if (bytes <= there) return;
    throw Error(SourcePlace(file.path().string()), ErrorKind::limit,
                fmt::format("{}: its {} values take {:.4g} MB of main memory, of which this "
                            "process may take {:.4g} MB: allow it more, or use a smaller file",
                            file.path().string(), array.cells(), bytes / 1e6, there / 1e6));
}

class ArrayDensity : public DensityField {
  public:
    ArrayDensity(const CellArray& array, const glm::dmat4& world_from_array) : size_(array.size()) {
        const InputFile file(array.data);
        if (array.is_color()) file.refuse("it holds colours, which are no density");
        if (array.cells() > kMaxDensityCells)
            file.refuse(fmt::format("it has {} cells; a density has 2^28 at most", array.cells()));
        check_array(array, file);
        check_room(array, file);
        // Coordinates in cells: the middle of the first cell is 0, and that of the next one 1.
        glm::dmat4 array_from_cell(1);
        for (int axis = 0; axis < 3; ++axis) array_from_cell[axis][axis] = array.voxel_edge[axis];
        array_from_cell[3] = glm::dvec4(array.first_corner + array.voxel_edge / 2.0, 1);
        cell_from_world_ = glm::inverse(world_from_array * array_from_cell);
        load(array, file);
        find_extremes();
    }

    double bytes() const override { return double(values_.size() * sizeof(float)); }

    std::optional<float> constant_in(const Bounds& box) const override {
        const ValueRange range = range_in(box);
        const float max = float(std::max(range.max, 0.0)), min = float(std::max(range.min, 0.0));
        if (range.min > range.max || max == 0) return 0.0f;
        return min == max && !range.reaches_out ? std::optional(max) : std::nullopt;
    }

    ValueRange range_in(const Bounds& box) const override {
        glm::dvec3 low(INFINITY), high(-INFINITY);
        for (int i = 0; i < 8; ++i) {
            const glm::dvec3 p(cell_from_world_ * glm::dvec4(corner(box, i), 1));
            low = glm::min(low, p);
            high = glm::max(high, p);
        }
        const glm::dvec3 end = glm::dvec3(size_) - 0.5;
        ValueRange range{INFINITY, -INFINITY, false};
        for (int axis = 0; axis < 3; ++axis) {
            range.reaches_out |= low[axis] < -0.5 || high[axis] > end[axis];
            if (high[axis] < -0.5 || low[axis] > end[axis]) return range;
        }
        const glm::ivec3 first = block_of(glm::floor(low)), last = block_of(glm::ceil(high));
        for (int z = first.z; z <= last.z; ++z)
            for (int y = first.y; y <= last.y; ++y)
                for (int x = first.x; x <= last.x; ++x) {
                    const Extremes& block =
                        extremes_[(size_t(z) * size_t(blocks_.y) + size_t(y)) * size_t(blocks_.x) +
                                  size_t(x)];
                    range.min = std::min(range.min, double(block.min));
                    range.max = std::max(range.max, double(block.max));
                    range.reaches_out |= block.has_gaps;
                }
        return range;
    }

    void sample(const glm::dvec3& first, const glm::dvec3& step,
                std::span<float, 4096> densities) const override {
        sample_values(first, step, glm::ivec3(16), densities);
        for (float& density : densities) density = std::max(density, 0.0f);
    }

    void sample_values(const glm::dvec3& first, const glm::dvec3& step, const glm::ivec3& count,
                       std::span<float> values) const override {
        const glm::dvec3 origin(cell_from_world_ * glm::dvec4(first, 1));
        const glm::dmat3 turn(cell_from_world_);
        if (is_along_axes(turn)) return sample_along_axes(origin, turn, step, count, values);
        size_t index = 0;
        for (int k = 0; k < count.z; ++k)
            for (int j = 0; j < count.y; ++j)
                for (int i = 0; i < count.x; ++i)
                    values[index++] = at(origin + turn * (step * glm::dvec3(i, j, k)));
    }

  private:
    /// Where a point lies along an axis: between a cell and the next one.
    struct Between {
        bool is_inside = false;
        int cell = 0;
        double share = 0;  ///< of the way to the next cell
    };

    /// `x` is in cells. Points on the border that rounding moves out of the array count as inside.
    Between between(double x, int axis) const {
        if (!(x >= -0.5 - 1e-9 && x <= size_[axis] - 0.5 + 1e-9)) return {};
        const double within = std::clamp(x, 0.0, double(size_[axis] - 1));
        const int cell = std::min(int(within), std::max(size_[axis] - 2, 0));
        return {true, cell, within - cell};
    }

    /// The value at a point, whose coordinates are in cells.
    float at(const glm::dvec3& p) const {
        return at(between(p.x, 0), between(p.y, 1), between(p.z, 2));
    }

    float at(const Between& x, const Between& y, const Between& z) const {
        if (!x.is_inside || !y.is_inside || !z.is_inside) return kOutsideScan;
        const size_t cell = index({x.cell, y.cell, z.cell});
        const size_t row = size_t(size_.x), slice = row * size_t(size_.y);
        double sum = 0;
        for (int c = 0; c < 8; ++c) {
            double weight = (c & 1) != 0 ? x.share : 1 - x.share;
            weight *= (c & 2) != 0 ? y.share : 1 - y.share;
            weight *= (c & 4) != 0 ? z.share : 1 - z.share;
            if (weight == 0) continue;  // also of a cell beyond the last
            const float value = values_[cell + size_t(c & 1) + ((c & 2) != 0 ? row : 0) +
                                        ((c & 4) != 0 ? slice : 0)];
            if (value == kOutsideScan) return kOutsideScan;
            sum += weight * double(value);
        }
        return float(sum);
    }

    static bool is_along_axes(const glm::dmat3& turn) {
        for (int column = 0; column < 3; ++column)
            for (int row = 0; row < 3; ++row)
                if (row != column && turn[column][row] != 0) return false;
        return true;
    }

    /// Samples points whose rows run along the array's axes.
    void sample_along_axes(const glm::dvec3& origin, const glm::dmat3& turn, const glm::dvec3& step,
                           const glm::ivec3& count, std::span<float> values) const {
        std::array<std::vector<Between>, 3> along;
        for (int axis = 0; axis < 3; ++axis)
            for (int i = 0; i < count[axis]; ++i)
                along[size_t(axis)].push_back(
                    between(origin[axis] + turn[axis][axis] * (step[axis] * i), axis));
        size_t index = 0;
        for (const Between& z : along[2])
            for (const Between& y : along[1])
                for (const Between& x : along[0]) values[index++] = at(x, y, z);
    }

    size_t index(const glm::ivec3& cell) const {
        return (size_t(cell.z) * size_t(size_.y) + size_t(cell.y)) * size_t(size_.x) +
               size_t(cell.x);
    }

    glm::ivec3 block_of(const glm::dvec3& cell) const {
        return glm::ivec3(glm::clamp(cell, glm::dvec3(0), glm::dvec3(size_ - 1))) / kBlockEdge;
    }

    /// Loads the values in the order of the model's axes.
    void load(const CellArray& array, const InputFile& file) {
        values_.resize(array.cells());
        ArraySlabs slabs(array, file, 1);
        glm::ivec3 number(0);
        for (; slabs.next() > 0; ++number.z)
            with_type(array.type, slabs.values(), [&](const auto* from) {
                for (number.y = 0; number.y < array.counts.y; ++number.y)
                    for (number.x = 0; number.x < array.counts.x; ++number.x) {
                        const float value = float(array.slope * double(*from++) + array.intercept);
                        values_[index(cell_of(array, number))] =
                            std::isfinite(value) ? value : kOutsideScan;
                    }
            });
    }

    static glm::ivec3 cell_of(const CellArray& array, const glm::ivec3& number) {
        glm::ivec3 cell;
        for (int axis = 0; axis < 3; ++axis) {
            const int from = array.axis[axis];
            cell[axis] =
                array.sign[axis] > 0 ? number[from] : array.counts[from] - 1 - number[from];
        }
        return cell;
    }

    void find_extremes() {
        blocks_ = (size_ + kBlockEdge - 1) / kBlockEdge;
        extremes_.resize(size_t(blocks_.x) * size_t(blocks_.y) * size_t(blocks_.z));
        size_t index = 0;
        for (int z = 0; z < size_.z; ++z)
            for (int y = 0; y < size_.y; ++y) {
                const size_t row =
                    (size_t(z / kBlockEdge) * size_t(blocks_.y) + size_t(y / kBlockEdge)) *
                    size_t(blocks_.x);
                for (int x = 0; x < size_.x; ++x)
                    extremes_[row + size_t(x / kBlockEdge)].add(values_[index++]);
            }
    }

    glm::ivec3 size_, blocks_{0};
    glm::dmat4 cell_from_world_{1};
    std::vector<float> values_;
    std::vector<Extremes> extremes_;  ///< one for each block, x fastest
};

}  // namespace

std::unique_ptr<DensityField> read_array_density(const CellArray& array,
                                                 const glm::dmat4& world_from_array) {
    return std::make_unique<ArrayDensity>(array, world_from_array);
}

}  // namespace voxelume
