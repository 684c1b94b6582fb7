// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_voxels.hpp"

#include <algorithm>
#include <bit>
#include <cstring>
#include <functional>
#include <glm/common.hpp>

#include "kernels/shared/voxel.h"
#include "runtime/base/huge_pages.hpp"
#include "runtime/base/input_file.hpp"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/io/voxels/voxel_limits.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kNoBrick = 0xFFFFFFFF;
constexpr uint32_t kNoColor = 0xFFFFFF;  // of cells without a voxel

/// A model where it stands, in the file's coordinates.
struct Standing {
    const VoxModel* model;
    VoxRotation rotation;
    glm::ivec3 translation;
};

/// The file's axes after the turn that brings Z up to Y up, which no box needs more than.
const VoxRotation kYUp{{0, 2, 1}, {1, 1, -1}};

/// Voxel v of a model fills [first + R v, first + R v + 1] in Y-up coordinates, R being a signed
/// permutation: this has R and `first`.
struct CellMap {
    VoxRotation rotation;
    glm::ivec3 first{0};
};

CellMap cell_map(const Standing& standing) {
    const VoxRotation r = kYUp * standing.rotation;
    const glm::ivec3 pivot = standing.model->size / 2;
    CellMap map{r, kYUp * standing.translation - r * pivot};
    // A mirrored axis ends where it would begin.
    for (int row = 0; row < 3; ++row)
        if (r.sign[size_t(row)] < 0) --map.first[row];
    return map;
}

struct CellBox {
    glm::ivec3 low{1 << 30}, high{-(1 << 30)};  ///< high is one past the last
};

CellBox box_of(const Standing& standing) {
    const CellMap map = cell_map(standing);
    const glm::ivec3 a = map.first, b = map.first + map.rotation * (standing.model->size - 1);
    return {glm::min(a, b), glm::max(a, b) + 1};
}

/// Cells of palette indices, brick by brick, where some model may have voxels.
class Cells {
  public:
    Cells(const CellBox& box, const InputFile& file) : file_(file) {
        const glm::dvec3 size = glm::dvec3(box.high - box.low) + 2.0 * kModelMargin;
        check_voxel_span(size, file);
        frame_.size = glm::ivec3(size);
        first_ = box.low - kModelMargin;
        frame_.origin = glm::dvec3(first_);
        numbers_.assign(bricks_of(frame_), kNoBrick);
    }

    /// Makes room for a box of cells.
    void add_box(const CellBox& box) {
        const glm::ivec3 low = (box.low - first_) / kBrickSize,
                         high = (box.high - 1 - first_) / kBrickSize, bricks = frame_.bricks();
        for (int z = low.z; z <= high.z; ++z)
            for (int y = low.y; y <= high.y; ++y)
                for (int x = low.x; x <= high.x; ++x) {
                    uint32_t& number =
                        numbers_[size_t(x) + size_t(bricks.x) * size_t(y + bricks.y * z)];
                    if (number == kNoBrick) number = count_++;
                }
        check_stored_bricks(count_, file_);
    }

    void allocate() {
        reserve_in_huge_pages(cells_, size_t(count_) * kVoxelsPerBrick);
        cells_.resize(size_t(count_) * kVoxelsPerBrick);
    }

    /// Sets the cells of a model's voxels to their palette indices.
    void add_voxels(const Standing& standing);

    /// Writes what is there to the model, by the palette's colours and groups.
    void fill(const std::array<uint32_t, 256>& colors, const std::array<uint32_t, 256>& groups,
              bool has_groups, VoxelModel& model) const;

    const GridFrame& frame() const { return frame_; }
    std::array<bool, 256> used() const;

  private:
    /// What a coordinate of a model's voxel adds to the place of its cell.
    struct Step {
        uint32_t brick = 0, cell = 0;
    };
    using Steps = std::array<std::array<Step, 256>, 3>;
    Steps steps_of(const Standing& standing) const;
    bool is_empty(size_t number) const {
        const uint8_t* cells = cells_.data() + number * kVoxelsPerBrick;
        return std::all_of(cells, cells + kVoxelsPerBrick, [](uint8_t c) { return c == 0; });
    }

    const InputFile& file_;
    GridFrame frame_;
    glm::ivec3 first_{0};
    std::vector<uint32_t> numbers_;  ///< by brick, into cells_
    uint32_t count_ = 0;
    std::vector<uint8_t> cells_;
};

/// Each row of the place depends on one coordinate alone, so that sums of three steps are places.
Cells::Steps Cells::steps_of(const Standing& standing) const {
    const CellMap map = cell_map(standing);
    const glm::ivec3 bricks = frame_.bricks();
    const glm::ivec3 brick_stride(1, bricks.x, bricks.x * bricks.y), cell_stride(1, 16, 256);
    Steps steps;
    for (int row = 0; row < 3; ++row) {
        const size_t axis = size_t(map.rotation.axis[size_t(row)]);
        for (int v = 0; v < standing.model->size[int(axis)]; ++v) {
            const int at = map.first[row] + map.rotation.sign[size_t(row)] * v - first_[row];
            steps[axis][size_t(v)] = {uint32_t(at / kBrickSize * brick_stride[row]),
                                      uint32_t(at % kBrickSize * cell_stride[row])};
        }
    }
    return steps;
}

void Cells::add_voxels(const Standing& standing) {
    constexpr size_t kBlock = 1 << 16;  // voxels read at once, which stay in the cache
    const VoxModel& model = *standing.model;
    const Steps steps = steps_of(standing);
    std::vector<uint32_t> block(std::min<size_t>(kBlock, model.voxels));
    for (size_t done = 0; done < model.voxels; done += block.size()) {
        const size_t count = std::min(block.size(), model.voxels - done);
        file_.read(model.voxels_at + 4 * done, block.data(), 4 * count);
        uint32_t x_max = 0, y_max = 0, z_max = 0;
        for (size_t i = 0; i < count; ++i) {
            x_max = std::max(x_max, block[i] & 255);
            y_max = std::max(y_max, block[i] >> 8 & 255);
            z_max = std::max(z_max, block[i] >> 16 & 255);
        }
        if (int(x_max) >= model.size.x || int(y_max) >= model.size.y || int(z_max) >= model.size.z)
            file_.refuse(fmt::format("a voxel lies outside of its model, which has {} x {} x {}",
                                     model.size.x, model.size.y, model.size.z));
        for (size_t i = 0; i < count; ++i) {
            const uint32_t v = block[i];
            const Step &x = steps[0][v & 255], &y = steps[1][v >> 8 & 255],
                       &z = steps[2][v >> 16 & 255];
            const uint32_t index = v >> 24;
            if (index != 0)
                cells_[size_t(numbers_[x.brick + y.brick + z.brick]) * kVoxelsPerBrick +
                       (x.cell + y.cell + z.cell)] = uint8_t(index);
        }
    }
}

std::array<bool, 256> Cells::used() const {
    std::array<bool, 256> used{};
    for (const uint8_t cell : cells_) used[cell] = true;
    used[0] = false;
    return used;
}

void Cells::fill(const std::array<uint32_t, 256>& colors, const std::array<uint32_t, 256>& groups,
                 bool has_groups, VoxelModel& model) const {
    model.frame = frame_;
    model.slots.assign(numbers_.size(), kBrickOutside);
    std::vector<uint32_t> sources;  // by slot
    for (size_t brick = 0; brick < numbers_.size(); ++brick) {
        if (numbers_[brick] == kNoBrick || is_empty(numbers_[brick])) continue;
        model.slots[brick] = uint32_t(sources.size());
        model.coordinates.push_back(uint32_t(brick));
        sources.push_back(numbers_[brick]);
    }
    model.occupancy.assign(sources.size() * kLeavesPerBrick, 0);
    reserve_in_huge_pages(model.colors, sources.size() * kVoxelsPerBrick);
    if (has_groups) reserve_in_huge_pages(model.attributes, sources.size() * kVoxelsPerBrick);
    std::array<uint32_t, kVoxelsPerBrick> words;
    const auto append = [&](const std::array<uint32_t, 256>& values, const uint8_t* cells,
                            std::vector<uint32_t>& to) {
        // By way of a brick in the cache: memory is touched once.
        for (size_t i = 0; i < kVoxelsPerBrick; ++i) words[i] = values[cells[i]];
        to.insert(to.end(), words.begin(), words.end());
    };
    for (size_t slot = 0; slot < sources.size(); ++slot) {
        const uint8_t* cells = cells_.data() + size_t(sources[slot]) * kVoxelsPerBrick;
        uint64_t* leaves = model.occupancy.data() + slot * kLeavesPerBrick;
        append(colors, cells, model.colors);
        if (has_groups) append(groups, cells, model.attributes);
        for (size_t row = 0; row < kVoxelsPerBrick / 4; ++row) {
            // Four cells along x share a leaf: bits 0-1 of `row` are its x, 2-5 y, 6-9 z.
            uint32_t four = 0;
            std::memcpy(&four, cells + 4 * row, 4);
            if (four == 0) continue;
            // The top bit of each byte that isn't 0, then byte i's at bit i.
            const uint32_t tops = (((four & 0x7F7F7F7Fu) + 0x7F7F7F7Fu) | four) >> 7 & 0x01010101u;
            const uint64_t bits = tops * 0x10204080u >> 28;
            const size_t y = row >> 2 & 15, z = row >> 6;
            leaves[(row & 3) | (y >> 2) << 2 | (z >> 2) << 4] |= bits
                                                                 << ((y & 3) << 2 | (z & 3) << 4);
        }
    }
}

/// What the part consists of.
std::vector<Standing> standing_in(const VoxFile& vox, int part, const InputFile& file) {
    std::vector<Standing> all;
    if (part < 0 || size_t(part) > vox.models.size())
        file.refuse(fmt::format("has {} models and no part {}", vox.models.size(), part));
    if (part > 0) return {{&vox.models[size_t(part - 1)], {}, {}}};
    for (const VoxObject& object : vox.objects) {
        if (object.hidden) continue;
        const VoxPose& pose = object.poses.front();
        all.push_back(
            {&vox.models[size_t(object.shown.front().model)], pose.rotation, pose.translation});
    }
    return all;
}

}  // namespace

VoxelModel read_vox_voxels(const VoxFile& vox, int part) {
    const InputFile file(vox.path);
    std::vector<Standing> all = standing_in(vox, part, file);
    std::erase_if(all, [](const Standing& standing) {
        const VoxModel& model = *standing.model;
        return model.voxels == 0 || std::min({model.size.x, model.size.y, model.size.z}) == 0;
    });
    if (all.empty()) file.refuse("has no voxels to show");
    CellBox box;
    for (const Standing& standing : all) {
        const CellBox one = box_of(standing);
        box = {glm::min(box.low, one.low), glm::max(box.high, one.high)};
    }
    Cells cells(box, file);
    for (const Standing& standing : all) cells.add_box(box_of(standing));
    cells.allocate();
    // Where objects overlap, the earlier one is seen, as in scenes.
    for (auto standing = all.rbegin(); standing != all.rend(); ++standing)
        cells.add_voxels(*standing);

    VoxelModel model;
    model.surface = Surface::cubes;
    std::array<uint32_t, 256> colors{}, groups{};
    for (size_t i = 0; i < colors.size(); ++i) colors[i] = vox.palette[i] & 0xFFFFFF;
    colors[0] = kNoColor;
    const bool has_materials = std::ranges::any_of(
        vox.materials, [](const VoxMaterial& m) { return m.kind != VoxMaterialKind::diffuse; });
    if (has_materials) {
        const std::array<bool, 256> used = cells.used();
        for (int i = 1; i < 256; ++i) {
            std::string name = used[size_t(i)] ? material_name(vox, i) : "";
            if (name.empty()) continue;
            if (model.groups.empty()) model.groups.emplace_back("diffuse");
            groups[size_t(i)] = uint32_t(model.groups.size()) << VXL_MATERIAL_SHIFT;
            model.groups.push_back(std::move(name));
        }
    }
    cells.fill(colors, groups, !model.groups.empty(), model);
    if (model.coordinates.empty()) file.refuse("has no voxels to show");
    return model;
}

glm::dmat4 placement_of(const VoxPose& pose) {
    // C R C^-1 for the turn C that brings Y up, whose inverse has -y of the file's as z.
    const VoxRotation back{{0, 2, 1}, {1, -1, 1}};
    const VoxRotation r = kYUp * pose.rotation * back;
    glm::dmat4 matrix(0);
    for (int row = 0; row < 3; ++row) matrix[r.axis[size_t(row)]][row] = r.sign[size_t(row)];
    matrix[3] = glm::dvec4(kYUp * pose.translation, 1);
    return matrix;
}

std::array<uint64_t, 256> count_palette(const VoxFile& vox) {
    const InputFile file(vox.path);
    std::array<uint64_t, 256> counts{};
    for (const VoxModel& model : vox.models) {
        std::vector<uint32_t> voxels(model.voxels);
        file.read(model.voxels_at, voxels.data(), 4 * voxels.size());
        for (const uint32_t voxel : voxels) ++counts[voxel >> 24];
    }
    return counts;
}

}  // namespace voxelume
