// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/vox_parts.hpp"

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <glm/common.hpp>
#include <glm/exponential.hpp>

#include "runtime/image/srgb.hpp"
#include "runtime/import/gloss.hpp"
#include "runtime/import/vox_sight.hpp"
#include "runtime/io/voxels/vox_voxels.hpp"

namespace voxelume {
namespace {

double linear_of(uint32_t level) {
    return srgb_to_linear(level / 255.0);
}

glm::dvec3 linear_color(uint32_t color) {
    return {linear_of(color & 255), linear_of(color >> 8 & 255), linear_of(color >> 16 & 255)};
}

/// The number in a group's name: "glass 12".
int entry_of(const std::string& group) {
    return std::atoi(group.c_str() + group.rfind(' ') + 1);
}

/// `, "materials": {...}` that gives each group but the first the material of its own name.
std::string members_of(const std::vector<std::string>& groups) {
    std::vector<std::string> members;
    for (size_t i = 1; i < groups.size(); ++i)
        members.push_back(fmt::format("{0}: {0}", json_text(groups[i])));
    return members.empty() ? "" : fmt::format(", \"materials\": {{{}}}", fmt::join(members, ", "));
}

/// True for a medium that absorbs enough light to be seen and does nothing else.
bool is_clear_medium(const VoxMaterial& m, const glm::dvec3& linear) {
    constexpr double kFaint = 0.9;
    return m.kind == VoxMaterialKind::media && m.absorbs &&
           std::min({linear.x, linear.y, linear.z}) < kFaint;
}

/// The absorption of coloured glass: light has the glass's colour after eight voxels.
std::string absorption_member(const VoxMaterial& m, const glm::dvec3& linear, double voxel) {
    constexpr double kTint = 0.125, kDarkest = 0.02;
    const glm::dvec3 absorption = glm::log(1.0 / glm::max(linear, kDarkest)) *
                                  (kTint * double(m.weight) + double(m.density)) / voxel;
    return fmt::format("\"absorption\": {}", json_list(rounded(absorption, 3)));
}

}  // namespace

Model vox_model(const ImportedFile& file, int part) {
    Model model;
    model.voxels = file.path;
    model.part = part;
    model.surface = Surface::cubes;
    return model;
}

std::string material_values(const VoxMaterial& m, uint32_t color, double voxel) {
    const glm::dvec3 linear = linear_color(color);
    switch (m.kind) {
        case VoxMaterialKind::metal:
            return "\"color\": [1, 1, 1], " + metal_members(m.weight, m.rough);
        case VoxMaterialKind::blend:
            return "\"color\": [1, 1, 1], " + metal_members(m.metal, m.rough) +
                   (m.weight > 0 ? fmt::format(", \"transmission\": {}, \"ior\": {}, {}",
                                               rounded(m.weight, 3), rounded(m.ior, 4),
                                               absorption_member(m, linear, voxel))
                                 : "");
        case VoxMaterialKind::glass:
            return fmt::format(
                "\"color\": [1, 1, 1], \"diffuse\": {}, \"specular\": 0.5, \"shininess\": {}, "
                "\"reflection\": 1, \"refraction\": {}, \"fresnel\": true, \"ior\": {}, {}",
                rounded(1 - m.weight, 3), shininess_of(m.rough), rounded(m.weight, 3),
                rounded(m.ior, 4), absorption_member(m, linear, voxel));
        case VoxMaterialKind::emit:
            return fmt::format(
                "\"color\": [1, 1, 1], \"emission\": {}",
                json_list(
                    rounded(linear * double(m.weight) * double((1 + m.flux) * (1 + m.flux)), 3)));
        case VoxMaterialKind::media: {
            const double matt = is_clear_medium(m, linear) ? 0 : 0.2 + 0.8 * double(m.density);
            return fmt::format(
                "\"color\": [1, 1, 1], \"diffuse\": {}, \"refraction\": {}, \"ior\": 1, {}",
                rounded(matt, 3), rounded(1 - matt, 3), absorption_member(m, linear, voxel));
        }
        case VoxMaterialKind::diffuse:
            break;
    }
    return "\"color\": [1, 1, 1]";
}

bool VoxParts::has_glass() const {
    return std::ranges::any_of(entries_, [&](int entry) {
        const VoxMaterial& m = vox_.materials[size_t(entry)];
        return m.kind == VoxMaterialKind::glass || m.kind == VoxMaterialKind::media ||
               (m.kind == VoxMaterialKind::blend && m.weight > 0);
    });
}

bool VoxParts::has_voxels(int model) {
    const VoxModel& from = vox_.models[size_t(model)];
    return from.voxels > 0 && std::min({from.size.x, from.size.y, from.size.z}) > 0;
}

std::string VoxParts::name_of(int model) {
    const auto found = names_.find(model);
    if (found != names_.end()) return found->second;
    return names_[model] =
               vox_.models.size() == 1 ? stem_of(file_) : fmt::format("part {}", model + 1);
}

std::string VoxParts::group_members(int model) {
    const std::vector<std::string>& groups = file_.assets.groups_of(vox_model(file_, model + 1));
    for (size_t i = 1; i < groups.size(); ++i) entries_.insert(entry_of(groups[i]));
    return members_of(groups);
}

bool VoxParts::is_emissive(int model) {
    const std::vector<std::string>& groups = file_.assets.groups_of(vox_model(file_, model + 1));
    for (size_t i = 1; i < groups.size(); ++i) {
        const VoxMaterial& material = vox_.materials[size_t(entry_of(groups[i]))];
        if (material.kind == VoxMaterialKind::emit && material.weight > 0) return true;
    }
    return false;
}

Bounds VoxParts::box_of(int model) {
    return file_.assets.box_of_file(vox_model(file_, model + 1), true);
}

std::vector<std::string> VoxParts::models() const {
    std::vector<std::string> members;
    members.reserve(names_.size());
    for (const auto& [model, name] : names_)
        members.push_back(fmt::format("{}: {{\"voxels\": {}, \"part\": {}}}", json_text(name),
                                      json_text(file_.name), model + 1));
    return members;
}

std::vector<std::string> VoxParts::materials(double voxel) const {
    std::vector<std::string> members = {"\"default\": {\"color\": [1, 1, 1]}"};
    for (const int entry : entries_)
        members.push_back(fmt::format(
            "{}: {{{}}}", json_text(material_name(vox_, entry)),
            material_values(vox_.materials[size_t(entry)], vox_.palette[size_t(entry)], voxel)));
    return members;
}

}  // namespace voxelume
