// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_voxels.hpp"

#include <algorithm>
#include <cstdint>
#include <glm/common.hpp>

#include "kernels/shared/voxel.h"
#include "runtime/base/files/input_file.hpp"
#include "runtime/io/voxels/vox_cells.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kNoColor = 0xFFFFFF;  // colour of cells without a voxel

/// The models of a part, with their placements.
std::vector<VoxStanding> standing_in(const VoxFile& vox, int part, const InputFile& file) {
    std::vector<VoxStanding> all;
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
    std::vector<VoxStanding> all = standing_in(vox, part, file);
    std::erase_if(all, [](const VoxStanding& standing) {
        const VoxModel& model = *standing.model;
        return model.voxels == 0 || std::min({model.size.x, model.size.y, model.size.z}) == 0;
    });
    if (all.empty()) file.refuse("has no voxels to show");
    CellBox box;
    for (const VoxStanding& standing : all) {
        const CellBox one = box_of(standing);
        box = {glm::min(box.low, one.low), glm::max(box.high, one.high)};
    }
    VoxCells cells(box, file);
    for (const VoxStanding& standing : all) cells.add_box(box_of(standing));
    cells.allocate();
    VoxelModel model;
    // Where objects overlap, the earlier one is visible, as in scenes.
    for (auto standing = all.rbegin(); standing != all.rend(); ++standing)
        cells.add_voxels(*standing);

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
    model.palette = colors;
    std::move(cells).fill(groups, !model.groups.empty(), model);
    if (model.coordinates.empty()) file.refuse("has no voxels to show");
    return model;
}

glm::dmat4 placement_of(const VoxPose& pose) {
    // C R C^-1 for the turn C to Y up, whose inverse has the file's -y as z.
    const VoxRotation back{{0, 2, 1}, {1, -1, 1}};
    const VoxRotation r = kVoxYUp * pose.rotation * back;
    glm::dmat4 matrix(0);
    for (int row = 0; row < 3; ++row) matrix[r.axis[size_t(row)]][row] = r.sign[size_t(row)];
    matrix[3] = glm::dvec4(kVoxYUp * pose.translation, 1);
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
