// SPDX-License-Identifier: Apache-2.0
// array -> cubes. Slabs of 16 layers become rows of bits, and these become the bits of bricks: the
// file is read in its own order, whatever the order of the model is.
#include <algorithm>
#include <atomic>
#include <cmath>
#include <cstring>
#include <mutex>

#include "kernels/shared/voxel.h"
#include "runtime/base/make_room.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/arrays/array_choice.hpp"
#include "runtime/io/arrays/array_codes.hpp"
#include "runtime/io/arrays/array_layout.hpp"
#include "runtime/io/arrays/array_stream.hpp"
#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kClear = 255u << VXL_TRANSPARENCY_SHIFT;  // the colour of no voxel
constexpr uint32_t kWhite = 0xFFFFFF;

class ArrayCubes {
  public:
    ArrayCubes(const CellArray& array, const VoxelValues& values)
        : array_(array),
          values_(values),
          file_(array.data),
          layout_(layout_of(array, file_)),
          bricks_(layout_.frame.bricks()),
          rows_x_(size_t(layout_.maps[0].bricks)),
          has_masks_(has_color_masks(array)) {
        if (array.is_color() && values.is_there())
            file_.refuse("it holds colours, which have no \"iso\" and no \"label\"");
        const std::array<int, 3> stride = {1, bricks_.x, bricks_.x * bricks_.y};
        for (size_t i = 0; i < 3; ++i) {
            const AxisMap& map = layout_.maps[i];
            brick_stride_[i] = stride[size_t(map.axis)] * map.step;
            first_brick_ += stride[size_t(map.axis)] * map.first;
            for (size_t cell = 0; cell < 16; ++cell) {
                const size_t at = map.is_mirrored ? 15 - cell : cell;
                leaf_[i][cell] = uint32_t(at / 4 << 2 * map.axis);
                bit_[i][cell] = uint32_t(at % 4 << 2 * map.axis);
                index_[i][cell] = uint32_t(at << 4 * map.axis);
            }
            if (i == 0) make_spread(map.axis);
        }
    }

    VoxelModel read() {
        read_bits();
        if (stored_ == 0) file_.refuse(reason_for_none(array_, values_));
        VoxelModel model;
        model.surface = Surface::cubes;
        model.frame = layout_.frame;
        model.slots.assign(voxelume::bricks_of(model.frame), kBrickOutside);
        std::vector<const uint64_t*> bits(model.slots.size());
        for (const Bricks& part : parts_)
            for (size_t i = 0; i < part.found.size(); ++i)
                bits[part.found[i]] = part.bits.data() + i * kLeavesPerBrick;
        model.coordinates.reserve(stored_);
        reserve_in_huge_pages(model.occupancy, stored_ * kLeavesPerBrick);
        for (size_t brick = 0; brick < bits.size(); ++brick) {
            if (bits[brick] == nullptr) continue;
            model.slots[brick] = uint32_t(model.coordinates.size());
            model.coordinates.push_back(uint32_t(brick));
            model.occupancy.insert(model.occupancy.end(), bits[brick],
                                   bits[brick] + kLeavesPerBrick);
        }
        parts_.clear();
        if (array_.is_color() || values_.each_label) read_colors(model);
        return model;
    }

  private:
    struct Bricks {                   ///< the results of one thread
        std::vector<uint32_t> found;  ///< numbers of bricks
        std::vector<uint64_t> bits;   ///< bits of their voxels, in the same order
    };

    /// Makes the table of the bits in a leaf of four neighbours along the file's first axis.
    void make_spread(int axis) {
        for (size_t four = 0; four < 16; ++four)
            for (size_t i = 0; i < 4; ++i) {
                const size_t at = layout_.maps[0].is_mirrored ? 3 - i : i;
                if (four >> i & 1) spread_[four] |= uint64_t{1} << (at << 2 * axis);
            }
    }

    void choose_row(const ArraySlabs& slabs, size_t first, uint8_t* chosen) const {
        const size_t count = size_t(array_.counts.x), channels = size_t(array_.channels);
        with_type(array_.type, slabs.values(), [&](const auto* values) {
            if (!array_.is_color()) return choose(values + first, count, array_, values_, chosen);
            for (size_t i = 0; i < count; ++i) {
                // The fourth channel, an opacity, decides if there is one; otherwise any colour but
                // black is a voxel.
                const size_t c_first = channels == 4 ? 3 : 0;
                chosen[i] = 0;
                for (size_t c = c_first; c < channels; ++c)
                    chosen[i] |= channel(slabs, values, first + i, c) > 0;
            }
        });
    }

    template <class Value>
    double channel(const ArraySlabs& slabs, const Value* values, size_t cell, size_t c) const {
        return array_.is_planar ? double(reinterpret_cast<const Value*>(slabs.values(int(c)))[cell])
                                : double(values[cell * size_t(array_.channels) + c]);
    }

    void read_bits() {
        for_layer_ranges(array_, kBrickSize, [&](int first, int end) {
            Bricks part;
            read_bits(first, end, part);
            const std::scoped_lock lock(mutex_);
            parts_.push_back(std::move(part));
        });
    }

    void read_bits(int first, int end, Bricks& part) {
        ArraySlabs slabs(array_, file_, kBrickSize, first, end);
        const size_t width = size_t(array_.counts.x), height = size_t(array_.counts.y);
        std::vector<uint8_t> chosen(16 * rows_x_);
        std::vector<uint16_t> words(rows_x_ * height * kBrickSize);
        for (int layers = slabs.next(); layers > 0; layers = slabs.next()) {
            for (size_t row = 0; row < size_t(layers) * height; ++row) {
                choose_row(slabs, row * width, chosen.data());
                pack_row(chosen.data(), rows_x_, words.data() + row * rows_x_);
            }
            for (int y = 0; y < layout_.maps[1].bricks; ++y)
                for (int x = 0; x < layout_.maps[0].bricks; ++x)
                    add_brick(words, {x, y, slabs.first() / kBrickSize}, layers, part);
        }
    }

    int number_of(const glm::ivec3& brick) const {
        return first_brick_ + brick.x * brick_stride_[0] + brick.y * brick_stride_[1] +
               brick.z * brick_stride_[2];
    }

    /// Adds the brick if one of its cells is chosen.
    void add_brick(const std::vector<uint16_t>& words, const glm::ivec3& brick, int layers,
                   Bricks& part) {
        const size_t height = size_t(array_.counts.y), y_first = size_t(brick.y) * kBrickSize,
                     rows = std::min<size_t>(kBrickSize, height - y_first);
        std::array<uint32_t, 256> rows_of_brick{};  // along the file's first axis
        for (size_t z = 0; z < size_t(layers); ++z)
            for (size_t y = 0; y < rows; ++y)
                rows_of_brick[16 * z + y] =
                    words[(z * height + y_first + y) * rows_x_ + size_t(brick.x)];
        if (std::ranges::count(rows_of_brick, 0u) == 256) return;
        const bool is_full = std::ranges::count(rows_of_brick, 0xFFFFu) == 256;
        std::array<uint64_t, kLeavesPerBrick> leaves{};
        if (is_full) leaves.fill(~0ull);
        for (size_t i = 0; i < 256 && !is_full; ++i)
            for (size_t x = 0; x < 16; x += 4)
                leaves[leaf_[1][i % 16] | leaf_[2][i / 16] | leaf_[0][x]] |=
                    spread_[rows_of_brick[i] >> x & 15] << (bit_[1][i % 16] + bit_[2][i / 16]);
        check_stored_bricks(++stored_, file_);
        part.found.push_back(uint32_t(number_of(brick)));
        make_room(part.bits, leaves.size());
        part.bits.insert(part.bits.end(), leaves.begin(), leaves.end());
    }

    void read_colors(VoxelModel& model) {
        if (!array_.is_color())
            for (int byte = 0; byte < 256; ++byte)
                byte_colors_[size_t(byte)] =
                    label_color_of(array_.type == CellType::i8 ? int8_t(byte) : byte);
        if (has_codes()) {
            for (size_t byte = 0; byte < 256; ++byte)
                model.palette[byte] = byte_colors_[byte] >= kClear ? kWhite : byte_colors_[byte];
            reserve_in_huge_pages(model.color_codes, model.coordinates.size() * kVoxelsPerBrick);
            model.color_codes.resize(model.coordinates.size() * kVoxelsPerBrick);
        } else {
            reserve_in_huge_pages(model.colors, model.coordinates.size() * kVoxelsPerBrick);
            model.colors.assign(model.coordinates.size() * kVoxelsPerBrick, kWhite);
        }
        std::atomic<bool> transparent = false;
        for_layer_ranges(array_, kBrickSize, [&](int first, int end) {
            if (read_colors(first, end, model)) transparent = true;
        });
        model.transparent = transparent;
    }

    /// True if the model keeps the file's bytes as codes of colours.
    bool has_codes() const { return !array_.is_color() && bytes_in_memory(array_.type) == 1; }

    /// True if a voxel lets light through.
    bool read_colors(int first, int end, VoxelModel& model) const {
        ArraySlabs slabs(array_, file_, kBrickSize, first, end);
        bool transparent = false;
        for (int layers = slabs.next(); layers > 0; layers = slabs.next())
            for (int y = 0; y < layout_.maps[1].bricks; ++y)
                for (int x = 0; x < layout_.maps[0].bricks; ++x) {
                    const glm::ivec3 brick(x, y, slabs.first() / kBrickSize);
                    const uint32_t slot = model.slots[size_t(number_of(brick))];
                    if (slot == kBrickOutside) continue;
                    if (has_codes())
                        code_brick(slabs, brick, layers,
                                   model.color_codes.data() + size_t(slot) * kVoxelsPerBrick);
                    else
                        transparent |= color_brick(slabs, brick, layers, slot, model);
                }
        return transparent;
    }

    void code_brick(const ArraySlabs& slabs, const glm::ivec3& brick, int layers,
                    uint8_t* codes) const {
        const glm::ivec3 low = brick * kBrickSize;
        glm::ivec3 count = glm::min(array_.counts - low, kBrickSize);
        count.z = layers;
        const size_t width = size_t(array_.counts.x), height = size_t(array_.counts.y);
        const auto* const first = reinterpret_cast<const uint8_t*>(slabs.values()) +
                                  size_t(low.y) * width + size_t(low.x);
        write_codes({first, width, width * height, count}, index_, codes);
    }

    bool color_brick(const ArraySlabs& slabs, const glm::ivec3& brick, int layers, uint32_t slot,
                     VoxelModel& model) const {
        bool transparent = false;
        const glm::ivec3 low = brick * kBrickSize, high = glm::min(low + kBrickSize, array_.counts);
        const size_t width = size_t(array_.counts.x), height = size_t(array_.counts.y);
        uint32_t* colors = model.colors.data() + size_t(slot) * kVoxelsPerBrick;
        with_type(array_.type, slabs.values(), [&](const auto* values) {
            // Neighbours often have one label: 512^3 words take 0.3 instead of 3 s.
            auto last = values[0];
            uint32_t last_color = color_of(slabs, values, 0);
            for (int z = 0; z < layers; ++z)
                for (int y = low.y; y < high.y; ++y)
                    for (int x = low.x; x < high.x; ++x) {
                        const size_t cell = (size_t(z) * height + size_t(y)) * width + size_t(x);
                        const uint32_t index = index_[2][size_t(z)] | index_[1][size_t(y - low.y)] |
                                               index_[0][size_t(x - low.x)];
                        const bool is_last = !array_.is_color() && values[cell] == last;
                        const uint32_t color = is_last ? last_color : color_of(slabs, values, cell);
                        if (!array_.is_color()) last = values[cell];
                        last_color = color;
                        // Cells without a voxel have no visible colour.
                        if (color >= kClear) continue;
                        colors[index] = color;
                        transparent |= color >> VXL_TRANSPARENCY_SHIFT != 0;
                    }
        });
        return transparent;
    }

    uint32_t label_color_of(double stored) const {
        const double value = array_.slope * stored + array_.intercept;
        return is_label(value) ? label_color(label_of(value)) : kClear;
    }

    template <class Value>
    uint32_t color_of(const ArraySlabs& slabs, const Value* values, size_t cell) const {
        if (!array_.is_color()) {
            if constexpr (sizeof(Value) == 1) return byte_colors_[uint8_t(values[cell])];
            return label_color_of(double(values[cell]));
        }
        const bool is_fraction = std::is_floating_point_v<Value> || has_masks_;
        const double full = array_.type == CellType::u16 && !has_masks_ ? 255.0 / 65535 : 1;
        uint32_t color = 0;
        for (size_t c = 0; c < 3; ++c)
            color |= code_of(full * channel(slabs, values, cell, c), is_fraction) << 8 * c;
        if (array_.channels == 4) {
            const double alpha = channel(slabs, values, cell, 3);
            // The faintest voxel still counts as a voxel.
            const uint32_t clear = 255 - code_of(full * alpha, is_fraction);
            color |= (alpha > 0 ? std::min(clear, 254u) : 255u) << VXL_TRANSPARENCY_SHIFT;
        }
        return color;
    }

    const CellArray& array_;
    const VoxelValues& values_;
    const InputFile file_;
    CubeLayout layout_;
    glm::ivec3 bricks_;
    size_t rows_x_;   ///< number of words in a row of cells
    bool has_masks_;  ///< colours are 0 or 1
    int first_brick_ = 0;
    std::array<int, 3> brick_stride_{};
    // Tables by the file's axis and the cell in a brick.
    std::array<std::array<uint32_t, 16>, 3> leaf_{}, bit_{}, index_{};
    std::array<uint64_t, 16> spread_{};
    std::array<uint32_t, 256> byte_colors_{};
    std::vector<Bricks> parts_;
    std::mutex mutex_;  ///< guards parts_
    std::atomic<size_t> stored_ = 0;
};

}  // namespace

VoxelModel cubes_of_array(const CellArray& array, const VoxelValues& values) {
    return ArrayCubes(array, values).read();
}

}  // namespace voxelume
