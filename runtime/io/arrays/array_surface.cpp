// SPDX-License-Identifier: Apache-2.0
// array -> the field of a smooth surface. Nodes are the middles of cells. The file is read three
// times, layer by layer: for sides, for steps, and for values close to the surface.
#include <algorithm>
#include <atomic>
#include <cmath>

#include "runtime/base/huge_pages.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/arrays/array_layout.hpp"
#include "runtime/io/arrays/array_sides.hpp"
#include "runtime/io/arrays/array_steps.hpp"
#include "runtime/io/arrays/array_stream.hpp"
#include "runtime/io/arrays/array_units.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr int kPad = 4;    // nodes around the array, as around other models
constexpr int kReach = 4;  // nodes from a crossing that gradients and resampling read
constexpr uint64_t kMaxCells = uint64_t{1} << 30;
constexpr uint64_t kMaxCompressedCells = uint64_t{1} << 28;  // a few bytes may stand for many cells

/// The model's positions of the cells along one of the file's axes.
struct AxisIndices {
    int axis = 0;  ///< axis of the model
    bool is_mirrored = false;
    std::vector<int> node;      ///< node of the model, by the file's cell
    std::vector<size_t> brick;  ///< by the file's cell: what it adds to the number of the brick
    std::vector<size_t> cell;   ///< by the file's cell: what it adds to the index in the brick
};

class ArraySurface {
  public:
    ArraySurface(const CellArray& array, const VoxelValues& values)
        : array_(array), file_(array.data), values_(array, values) {
        if (array.is_color())
            file_.refuse("it holds colours, which have no surface: give it \"cubes\"");
        if (values.each_label)
            file_.refuse("a smooth surface has one \"label\"; give it \"cubes\" for each");
        if (array.cells() > kMaxCells)
            file_.refuse(fmt::format("it has {} cells; a smooth surface runs through {} at most",
                                     array.cells(), kMaxCells));
        if (array.is_compressed() && array.cells() > kMaxCompressedCells)
            file_.refuse(
                fmt::format("it has {} compressed cells; a smooth surface runs through {} "
                            "at most: save it raw",
                            array.cells(), kMaxCompressedCells));
        model_.surface = Surface::smooth;
        model_.frame.size = array.size() + 2 * kPad;
        check_voxel_span(glm::dvec3(model_.frame.size), file_);
        model_.frame.voxel_edge = array.voxel_edge;
        model_.frame.origin = array.first_corner + array.voxel_edge * (0.5 - kPad);
        for (int axis = 0; axis < 3; ++axis) make_axis_indices(axis);
    }

    VoxelModel read() {
        sides_ = sides_of_array(array_, file_, values_);
        if (!values_.are_crossed(sides_.min, sides_.max)) file_.refuse(fault());
        find_close();
        measure_steps();
        // A body that fills the array has no surface except at the array's ends.
        if (steepest_ == 0 && has_cut_)
            steepest_ = std::max(SurfaceValues::step_between(sides_.max, sides_.min), 1e-30f);
        if (!(steepest_ > 0)) file_.refuse(fault());
        number_bricks();
        close_.dilate(kReach);
        fill();
        return std::move(model_);
    }

  private:
    void make_axis_indices(int axis) {
        AxisIndices& indices = axis_indices_[size_t(array_.axis[axis])];
        const int count = array_.counts[array_.axis[axis]];
        const glm::ivec3 bricks = model_.frame.bricks();
        const std::array<size_t, 3> stride = {1, size_t(bricks.x),
                                              size_t(bricks.x) * size_t(bricks.y)};
        indices.axis = axis;
        indices.is_mirrored = array_.sign[axis] < 0;
        for (int cell = 0; cell < count; ++cell) {
            const int node = kPad + (indices.is_mirrored ? count - 1 - cell : cell);
            indices.node.push_back(node);
            indices.brick.push_back(size_t(node / kBrickSize) * stride[size_t(axis)]);
            indices.cell.push_back(size_t(node % kBrickSize) << 4 * axis);
        }
    }

    std::string fault() const {
        return fmt::format("has no surface at {}: its values go from {:g} to {:g}",
                           values_.in_words(), sides_.min, sides_.max);
    }

    /// True if cell `i` along the file's axis has a next one.
    bool has_next(int axis, int i) const { return i >= 0 && i + 1 < array_.counts[axis]; }

    /// Marks the cells at the surface: of two neighbours on both sides, the one that comes first in
    /// the model, and cells inside at the array's ends.
    void find_close() {
        close_ = CellBits(array_.counts);
        std::atomic<bool> has_cut = false;
        for_ranges(array_.counts.z, array_.cells(), [&](int first, int end) {
            std::vector<uint64_t> pairs(close_.words());
            for (int z = first; z < end; ++z)
                for (int y = 0; y < array_.counts.y; ++y) {
                    find_close_pairs(y, z, pairs);
                    if (find_cut(y, z)) has_cut = true;
                }
        });
        has_cut_ = has_cut;
        is_near_.assign(bricks_of(model_.frame), false);
        for (int z = 0; z < array_.counts.z; ++z)
            for (int y = 0; y < array_.counts.y; ++y)
                for (size_t word = 0; word < close_.words(); ++word)
                    for_each_bit(close_.row(y, z)[word], word, [&](int x) { mark(x, y, z); });
    }

    void find_close_pairs(int y, int z, std::vector<uint64_t>& pairs) {
        uint64_t* close = close_.row(y, z);
        sides_.pairs(0, y, z, pairs.data());
        for (size_t i = 0; i < pairs.size(); ++i)
            close[i] = !axis_indices_[0].is_mirrored ? pairs[i]
                       : i == 0                      ? pairs[i] << 1
                                                     : pairs[i] << 1 | pairs[i - 1] >> 63;
        for (int axis = 1; axis < 3; ++axis) {
            const int back = axis_indices_[size_t(axis)].is_mirrored ? 1 : 0;
            const int from_y = axis == 1 ? y - back : y, from_z = axis == 2 ? z - back : z;
            if (!has_next(axis, axis == 1 ? from_y : from_z)) continue;
            sides_.pairs(axis, from_y, from_z, pairs.data());
            for (size_t i = 0; i < pairs.size(); ++i) close[i] |= pairs[i];
        }
    }

    /// Marks cells inside at the array's ends. True if there are some in this row, so that the body
    /// is cut off.
    bool find_cut(int y, int z) {
        const bool is_edge =
            y == 0 || y + 1 == array_.counts.y || z == 0 || z + 1 == array_.counts.z;
        const uint64_t* inside = sides_.inside.row(y, z);
        uint64_t* close = close_.row(y, z);
        const size_t last = size_t(array_.counts.x - 1) / 64;
        bool has_cut = false;
        for (size_t i = 0; i <= last; i += is_edge || last == 0 ? 1 : last) {
            uint64_t ends = is_edge ? ~uint64_t{0} : 0;
            if (i == 0) ends |= 1;
            if (i == last) ends |= uint64_t{1} << (array_.counts.x - 1) % 64;
            close[i] |= inside[i] & ends;
            has_cut |= (inside[i] & ends) != 0;
        }
        return has_cut;
    }

    /// Marks the bricks whose nodes lie near a cell at the surface.
    void mark(int x, int y, int z) {
        glm::ivec3 node;
        node[axis_indices_[0].axis] = axis_indices_[0].node[size_t(x)];
        node[axis_indices_[1].axis] = axis_indices_[1].node[size_t(y)];
        node[axis_indices_[2].axis] = axis_indices_[2].node[size_t(z)];
        const glm::ivec3 low = glm::max(node - kReach, 0) / kBrickSize,
                         high = glm::min(node + 1 + kReach, model_.frame.size) / kBrickSize,
                         bricks = model_.frame.bricks();
        for (int k = low.z; k <= high.z; ++k)
            for (int j = low.y; j <= high.y; ++j)
                for (int i = low.x; i <= high.x; ++i)
                    is_near_[size_t(i) + size_t(bricks.x) * size_t(j + bricks.y * k)] = true;
    }

    /// Finds the steepest step through the surface, per shortest edge of a voxel.
    void measure_steps() {
        const glm::dvec3 edge = model_.frame.voxel_edge;
        const glm::vec3 by_axis(std::min({edge.x, edge.y, edge.z}) / edge);
        glm::vec3 weight;
        for (int axis = 0; axis < 3; ++axis)
            weight[axis] = by_axis[axis_indices_[size_t(axis)].axis];
        steepest_ = steepest_step(array_, file_, values_, sides_, weight);
    }

    /// The cell of the file at a node, or the nearest one.
    glm::ivec3 cell_at(const glm::ivec3& node) const {
        glm::ivec3 cell;
        for (int i = 0; i < 3; ++i) {
            const AxisIndices& indices = axis_indices_[size_t(i)];
            const int count = array_.counts[i];
            const int at = std::clamp(node[indices.axis] - kPad, 0, count - 1);
            cell[i] = indices.is_mirrored ? count - 1 - at : at;
        }
        return cell;
    }
    glm::ivec3 nearest_cell_node(const glm::ivec3& node) const {
        return glm::clamp(node, glm::ivec3(kPad), array_.size() + (kPad - 1));
    }
    bool is_inside(const glm::ivec3& node) const { return sides_.inside(cell_at(node)); }

    void number_bricks() {
        model_.slots.resize(is_near_.size());
        for (size_t brick = 0; brick < is_near_.size(); ++brick) {
            if (is_near_[brick]) {
                model_.slots[brick] = uint32_t(model_.coordinates.size());
                model_.coordinates.push_back(uint32_t(brick));
                continue;
            }
            const glm::ivec3 first = brick_corner(model_.frame, brick);
            const bool is_pad = first != nearest_cell_node(first);
            model_.slots[brick] = !is_pad && is_inside(first) ? kBrickInside : kBrickOutside;
        }
        check_stored_bricks(model_.coordinates.size(), file_);
    }

    void fill() {
        const size_t bricks = model_.coordinates.size(), nodes = bricks * kVoxelsPerBrick;
        reserve_in_huge_pages(model_.distance, nodes);
        model_.distance.resize(nodes);
        const ArrayUnits units(values_, steepest_, array_.type);
        const std::vector<CellRun> runs = runs_of(axis_indices_[0].brick);
        for_layer_ranges(array_, 1, [&](int first, int end) {
            ArraySlabs slabs(array_, file_, 1, first, end);
            while (slabs.next() > 0)
                with_type(array_.type, slabs.values(), [&](const auto* layer) {
                    for (int y = 0; y < array_.counts.y; ++y)
                        for (const CellRun& run : runs)
                            fill_run(layer + size_t(y) * size_t(array_.counts.x), run, y,
                                     slabs.first(), units);
                });
        });
        for_ranges(int(bricks), nodes, [&](int first, int end) {
            for (int slot = first; slot < end; ++slot) fill_pad(size_t(slot));
        });
    }

    /// Fills the nodes of a run. Far from the surface they store only their side, however flat the
    /// values are there.
    template <class Value>
    void fill_run(const Value* row, const CellRun& run, int y, int z, const ArrayUnits& units) {
        const AxisIndices &y_indices = axis_indices_[1], &z_indices = axis_indices_[2];
        const size_t number = run.brick + y_indices.brick[size_t(y)] + z_indices.brick[size_t(z)];
        if (!is_near_[number]) return;
        int16_t* const out = model_.distance.data() + model_.slots[number] * kVoxelsPerBrick +
                             y_indices.cell[size_t(y)] + z_indices.cell[size_t(z)];
        const uint32_t close = close_.from(run.first, y, z),
                       inside = sides_.inside.from(run.first, y, z);
        for (int x = run.first; x < run.end; ++x) {
            const bool is_close = close >> (x - run.first) & 1,
                       is_inside = inside >> (x - run.first) & 1;
            out[axis_indices_[0].cell[size_t(x)]] = is_close    ? units(row[x])
                                                    : is_inside ? int16_t(-kMaxUnits)
                                                                : kMaxUnits;
        }
    }

    /// Fills nodes outside of the array with mirrored values, at most a voxel, so that the surface
    /// closes at the array's end. Two nodes outside they are at least a voxel, or values close to 0
    /// would go on as rods.
    void fill_pad(size_t slot) {
        const glm::ivec3 corner = brick_corner(model_.frame, model_.coordinates[slot]);
        const glm::ivec3 top = corner + (kBrickSize - 1);
        if (corner == nearest_cell_node(corner) && top == nearest_cell_node(top)) return;
        int16_t* out = model_.distance.data() + slot * kVoxelsPerBrick;
        for (size_t i = 0; i < kVoxelsPerBrick; ++i) {
            const glm::ivec3 node = corner + cell_in_brick(i), from = nearest_cell_node(node);
            if (node == from) continue;
            const int value = stored(from), voxel = int(kDistanceUnitsPerVoxel);
            const int mirrored = value < 0 ? std::min(-value, voxel) : value;
            const bool is_next = glm::all(glm::lessThan(glm::abs(node - from), glm::ivec3(2)));
            out[i] = int16_t(is_next ? mirrored : std::max(mirrored, voxel));
        }
    }

    int stored(const glm::ivec3& node) const {
        const glm::ivec3 b = node / kBrickSize, in = node % kBrickSize,
                         bricks = model_.frame.bricks();
        const size_t brick = size_t(b.x) + size_t(bricks.x) * size_t(b.y + bricks.y * b.z);
        if (!is_near_[brick]) return is_inside(node) ? -kMaxUnits : kMaxUnits;
        return model_
            .distance[model_.slots[brick] * kVoxelsPerBrick + size_t(in.x | in.y << 4 | in.z << 8)];
    }

    const CellArray& array_;
    const InputFile file_;
    const SurfaceValues values_;
    VoxelModel model_;
    std::array<AxisIndices, 3> axis_indices_;  ///< by the file's axes
    ArraySides sides_;
    CellBits close_;                ///< within kReach of the surface
    std::vector<uint8_t> is_near_;  ///< by brick
    float steepest_ = 0;
    bool has_cut_ = false;  ///< the body is cut off by the array's ends
};

}  // namespace

VoxelModel surface_of_array(const CellArray& array, const VoxelValues& values) {
    return ArraySurface(array, values).read();
}

}  // namespace voxelume
