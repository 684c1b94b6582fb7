// SPDX-License-Identifier: Apache-2.0
#include "runtime/assets/voxel_paint.hpp"

#include <algorithm>
#include <bit>
#include <cmath>
#include <optional>
#include <vector>

#include "kernels/shared/voxel.h"
#include "runtime/grid/brick_cells.hpp"
#include "runtime/image/srgb.hpp"
#include "runtime/io/image/png.hpp"

namespace voxelume {
namespace {

/// The colours of voxels of one material.
class Paint {
  public:
    explicit Paint(const Material& material)
        : color_(color_of(material)), opacity_(material.opacity) {}

    /// The colour code 0xTTBBGGRR, multiplied by the material's colour and opacity.
    uint32_t of(uint32_t code) const {
        static const std::vector<float> levels = srgb_levels();
        uint32_t painted = 0;
        for (int c = 0; c < 3; ++c)
            painted |= uint32_t(srgb_code(levels[code >> 8 * c & 255] * color_[c])) << 8 * c;
        const double opacity =
            double(255 - (code >> VXL_TRANSPARENCY_SHIFT)) / 255 * double(opacity_);
        return painted | uint32_t(std::lround(255 - 255 * opacity)) << VXL_TRANSPARENCY_SHIFT;
    }

  private:
    glm::vec3 color_;
    float opacity_;
};

/// The colour of a voxel in a stored brick: of the one in the middle of the side at +X if it is
/// occupied, else of the first voxel; empty without voxels.
std::optional<uint32_t> color_in(const VoxelModel& model, uint32_t slot,
                                 std::span<const uint32_t> colors) {
    constexpr glm::ivec3 kMiddle(kBrickSize - 1, kBrickSize / 2, kBrickSize / 2);
    const auto leaves = std::span(model.occupancy).subspan(slot * kLeavesPerBrick, kLeavesPerBrick);
    const size_t first = slot * kVoxelsPerBrick;
    if ((leaves[leaf_in_brick(kMiddle)] & bit_in_leaf(kMiddle)) != 0)
        return colors[first + voxel_in_brick(kMiddle)];
    for (size_t leaf = 0; leaf < kLeavesPerBrick; ++leaf)
        if (leaves[leaf] != 0)
            return colors[first + voxel_in_brick(leaf_corner(leaf) +
                                                 cell_in_leaf(std::countr_zero(leaves[leaf])))];
    return std::nullopt;
}

/// The colours of full bricks, for which no material is stored. A full brick takes the colour of
/// the stored brick before it along X, which belongs to the same solid.
std::vector<uint32_t> colors_of_full(const VoxelModel& model, std::span<const uint32_t> colors) {
    if (std::ranges::find(model.slots, kBrickInside) == model.slots.end()) return {};
    std::vector<uint32_t> full(model.slots.size());
    uint32_t last = 0xFFFFFFu;
    for (size_t brick = 0; brick < model.slots.size(); ++brick) {
        const uint32_t slot = model.slots[brick];
        if (slot < kBrickInside) last = color_in(model, slot, colors).value_or(last);
        if (slot == kBrickInside) full[brick] = last;
    }
    return full;
}

}  // namespace

void paint_voxels(std::span<const Material> materials, uint32_t attribute, VoxelModel& model) {
    const std::vector<Paint> paints(materials.begin(), materials.end());
    if (model.colors.empty())
        model.colors.assign(model.coordinates.size() * kVoxelsPerBrick, 0xFFFFFFu);
    std::vector<uint32_t>& colors = model.colors;
    for (size_t leaf = 0; leaf < model.occupancy.size(); ++leaf) {
        const size_t brick = leaf / kLeavesPerBrick * kVoxelsPerBrick;
        const glm::ivec3 corner = leaf_corner(leaf % kLeavesPerBrick);
        uint64_t& occupied = model.occupancy[leaf];
        for (int cell = 0; cell < 64; ++cell) {
            const uint64_t bit = uint64_t{1} << cell;
            const size_t index = brick + voxel_in_brick(corner + cell_in_leaf(cell));
            if ((occupied & bit) == 0) {
                colors[index] = 0xFFFFFFu;
                continue;
            }
            const uint32_t packed = model.attributes.empty() ? attribute : model.attributes[index];
            colors[index] =
                paints[packed >> VXL_MATERIAL_SHIFT & VXL_MATERIAL_MASK].of(colors[index]);
            const bool is_clear = colors[index] >> VXL_TRANSPARENCY_SHIFT == 255;
            if (is_clear) occupied &= ~bit;
            model.transparent |= !is_clear && colors[index] >> VXL_TRANSPARENCY_SHIFT > 0;
        }
    }
    model.full_colors = colors_of_full(model, colors);
    if (model.attributes.empty()) model.attributes.assign(colors.size(), attribute);
}

}  // namespace voxelume
