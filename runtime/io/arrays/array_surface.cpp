// SPDX-License-Identifier: Apache-2.0
// array -> the field of a smooth surface. Nodes are the middles of the array's cells.
#include <algorithm>
#include <cmath>

#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/arrays/array_stream.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr int kPad = 4;       // nodes around the array, as around other models
constexpr size_t kReach = 4;  // nodes from a crossing that gradients and resampling read
constexpr uint64_t kMaxCells = uint64_t{1} << 30;
constexpr uint64_t kMaxCompressedCells = uint64_t{1} << 28;  // few bytes tell many of them
constexpr float kMaxUnits = 32767;
constexpr double kMaxStep = 1e37;  // of which floats hold sums

/// How far a value is below another one. Infinity stays what it is.
float step_between(double high, double low) {
    const double step = high - low;
    return float(std::isfinite(step) ? std::clamp(step, -kMaxStep, kMaxStep) : step);
}

class ArraySurface {
  public:
    ArraySurface(const CellArray& array, const VoxelValues& values)
        : array_(array), values_(values), file_(array.data) {
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
        frame_.size = array.size() + 2 * kPad;
        check_voxel_span(glm::dvec3(frame_.size), file_);
        frame_.voxel_edge = array.voxel_edge;
        frame_.origin = array.first_corner + array.voxel_edge * (0.5 - kPad);
        for (size_t axis = 0; axis < 3; ++axis) make_offsets(int(axis));
    }

    VoxelModel read() {
        measure();
        if (!may_have_surface()) file_.refuse(fault());
        load();
        find_crossings();
        if (!(steepest_ > 0)) file_.refuse(fault());
        VoxelModel model;
        model.surface = Surface::smooth;
        model.frame = frame_;
        number_bricks(model);
        fill(model);
        return model;
    }

  private:
    void make_offsets(int axis) {
        const int from = array_.axis[axis], count = array_.counts[from];
        const std::array<size_t, 3> stride = {1, size_t(array_.counts.x),
                                              size_t(array_.counts.x) * size_t(array_.counts.y)};
        for (int node = 0; node < (frame_.size[axis] / kBrickSize + 1) * kBrickSize; ++node) {
            const int cell = std::clamp(node - kPad, 0, count - 1);
            const int at = array_.sign[axis] < 0 ? count - 1 - cell : cell;
            offsets_[size_t(axis)].push_back(size_t(at) * stride[size_t(from)]);
            is_pad_[size_t(axis)].push_back(node - kPad != cell);
        }
    }

    std::string fault() const {
        const std::string where =
            values_.label ? fmt::format("the label {}", *values_.label)
            : values_.iso || is_float(array_.type)
                ? fmt::format("the value {} (\"iso\")", values_.iso.value_or(0.5))
                : std::string("values that aren't 0");
        return fmt::format("has no surface at {}: its values go from {:g} to {:g}", where, min_,
                           max_);
    }

    /// Whether what is looked for is one value, or all but 0.
    bool is_set() const { return values_.label || (!values_.iso && !is_float(array_.type)); }

    /// Calls `use` with the number of each cell and its value.
    template <class Use>
    void for_each_value(const Use& use) const {
        ArraySlabs slabs(array_, file_, 1);
        const size_t layer = size_t(array_.counts.x) * size_t(array_.counts.y);
        while (slabs.next() > 0) {
            const size_t first = size_t(slabs.first()) * layer;
            with_type(array_.type, slabs.values(), [&](const auto* values) {
                for (size_t i = 0; i < layer; ++i)
                    use(first + i, array_.slope * double(values[i]) + array_.intercept);
            });
        }
    }

    /// Finds the range of the values, before memory is taken for all of them.
    void measure() {
        min_ = INFINITY;
        max_ = -INFINITY;
        for_each_value([&](size_t, double v) {
            min_ = std::min(min_, v);
            max_ = std::max(max_, v);
        });
    }

    /// False where no value in the range lies inside.
    bool may_have_surface() const {
        if (values_.label) return min_ <= *values_.label && *values_.label <= max_;
        return is_set() ? min_ != 0 || max_ != 0 : max_ > values_.iso.value_or(0.5);
    }

    /// Reads the values as how far they are below what is looked for.
    void load() {
        field_.resize(array_.cells());
        const bool is_one = is_set();
        const double iso = values_.iso.value_or(0.5), label = values_.label.value_or(0);
        for_each_value([&](size_t cell, double v) {
            field_[cell] = is_one ? ((v == label) == values_.label.has_value() ? -0.5f : 0.5f)
                                  : step_between(iso, v);
        });
    }

    size_t index(int x, int y, int z) const {
        return offsets_[0][size_t(x)] + offsets_[1][size_t(y)] + offsets_[2][size_t(z)];
    }
    /// The node's value in the array.
    float at(int x, int y, int z) const { return field_[index(x, y, z)]; }

    /// Widens what is close to the surface by kReach cells along each axis. Farther nodes store
    /// nothing but their side, however flat the values are there.
    void spread() {
        const std::array<size_t, 3> count = {size_t(array_.counts.x), size_t(array_.counts.y),
                                             size_t(array_.counts.z)};
        size_t stride = 1;
        for (size_t axis = 0; axis < 3; stride *= count[axis++])
            for (size_t outer = 0; outer < field_.size(); outer += stride * count[axis])
                for (size_t inner = 0; inner < stride; ++inner)
                    spread_row(outer + inner, stride, count[axis]);
    }

    void spread_row(size_t first, size_t stride, size_t count) {
        constexpr size_t kNever = size_t{1} << 40;
        row_.assign(count, 0);
        size_t since = kNever, until = kNever;
        for (size_t i = 0; i < count; ++i) {
            since = is_close_[first + i * stride] ? 0 : since + 1;
            row_[i] = since <= kReach;
        }
        for (size_t i = count; i-- > 0;) {
            until = is_close_[first + i * stride] ? 0 : until + 1;
            if (row_[i] || until <= kReach) is_close_[first + i * stride] |= 2;
        }
        for (size_t i = 0; i < count; ++i) {
            uint8_t& close = is_close_[first + i * stride];
            close = close != 0;
        }
    }

    /// Notes the steepest step through the surface, and the bricks around all of them.
    void find_crossings() {
        is_near_.assign(bricks_of(frame_), false);
        is_close_.assign(field_.size(), 0);
        const double shortest =
            std::min({frame_.voxel_edge.x, frame_.voxel_edge.y, frame_.voxel_edge.z});
        const glm::vec3 weight(shortest / frame_.voxel_edge);
        const glm::ivec3 end = array_.size() + kPad;
        for (int z = kPad; z < end.z; ++z)
            for (int y = kPad; y < end.y; ++y) {
                const bool is_edge = y == kPad || y + 1 == end.y || z == kPad || z + 1 == end.z;
                for (int x = kPad; x < end.x; ++x) {
                    const float f = at(x, y, z);
                    float step = 0;
                    const auto cross = [&](float other, float scale) {
                        if ((f < 0) != (other < 0) && std::isfinite(f) && std::isfinite(other))
                            step = std::max(step, std::abs(f - other) * scale);
                    };
                    cross(at(x + 1, y, z), weight.x);
                    cross(at(x, y + 1, z), weight.y);
                    cross(at(x, y, z + 1), weight.z);
                    const bool is_cut = f < 0 && (is_edge || x == kPad || x + 1 == end.x);
                    if (step == 0 && !is_cut) continue;
                    has_cut_ |= is_cut;
                    steepest_ = std::max(steepest_, step);
                    mark({x, y, z});
                    is_close_[index(x, y, z)] = 1;
                }
            }
        spread();
        // A body that fills the array has no surface but its ends.
        if (steepest_ == 0 && has_cut_) steepest_ = std::max(step_between(max_, min_), 1e-30f);
    }

    void mark(const glm::ivec3& node) {
        const glm::ivec3 low = glm::max(node - int(kReach), 0) / kBrickSize,
                         high = glm::min(node + 1 + int(kReach), frame_.size) / kBrickSize,
                         bricks = frame_.bricks();
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x)
                    is_near_[size_t(x) + size_t(bricks.x) * size_t(y + bricks.y * z)] = true;
    }

    void number_bricks(VoxelModel& model) const {
        model.slots.resize(is_near_.size());
        for (size_t brick = 0; brick < is_near_.size(); ++brick) {
            const glm::ivec3 first = brick_corner(model.frame, brick);
            if (is_near_[brick]) {
                model.slots[brick] = uint32_t(model.coordinates.size());
                model.coordinates.push_back(uint32_t(brick));
            } else {
                model.slots[brick] =
                    units(first.x, first.y, first.z) < 0 ? kBrickInside : kBrickOutside;
            }
        }
        check_stored_bricks(model.coordinates.size(), file_);
    }

    /// The distance that the node stores: the steepest step is a voxel long. Outside of the array
    /// the values are mirrored, and no farther than a voxel, so that the end is found.
    int16_t units(int x, int y, int z) const {
        const float f = at(x, y, z);
        const float whole = f < 0 ? -kMaxUnits : kMaxUnits;
        const float scaled =
            is_close_[index(x, y, z)] && std::isfinite(f)
                ? std::clamp(f / steepest_ * float(kDistanceUnitsPerVoxel), -kMaxUnits, kMaxUnits)
                : whole;
        const bool is_pad = is_pad_[0][size_t(x)] || is_pad_[1][size_t(y)] || is_pad_[2][size_t(z)];
        if (is_pad && scaled < 0)
            return int16_t(std::lround(std::min(-scaled, float(kDistanceUnitsPerVoxel))));
        return int16_t(std::lround(scaled));
    }

    void fill(VoxelModel& model) const {
        model.distance.resize(model.coordinates.size() * kVoxelsPerBrick);
        for (size_t slot = 0; slot < model.coordinates.size(); ++slot) {
            const glm::ivec3 first = brick_corner(model.frame, model.coordinates[slot]);
            int16_t* out = model.distance.data() + slot * kVoxelsPerBrick;
            for (int z = 0; z < kBrickSize; ++z)
                for (int y = 0; y < kBrickSize; ++y)
                    for (int x = 0; x < kBrickSize; ++x)
                        *out++ = units(first.x + x, first.y + y, first.z + z);
        }
    }

    const CellArray& array_;
    const VoxelValues& values_;
    const InputFile file_;
    GridFrame frame_;
    std::array<std::vector<size_t>, 3> offsets_;  ///< by the model's axis and node
    std::array<std::vector<char>, 3> is_pad_;     ///< likewise
    std::vector<float> field_;                    ///< in the file's order; negative inside
    std::vector<bool> is_near_;                   ///< by brick
    std::vector<uint8_t> is_close_;               ///< within kReach of the surface, as field_
    std::vector<uint8_t> row_;                    ///< of is_close_
    float steepest_ = 0;                          ///< step through the surface, per shortest edge
    bool has_cut_ = false;                        ///< the body goes on where the array ends
    double min_ = 0, max_ = 0;
};

}  // namespace

VoxelModel surface_of_array(const CellArray& array, const VoxelValues& values) {
    return ArraySurface(array, values).read();
}

}  // namespace voxelume
