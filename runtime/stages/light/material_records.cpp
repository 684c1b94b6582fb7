// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/material_records.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <span>
#include <utility>

#include "runtime/stages/light/tables/albedo_table.hpp"
#include "runtime/stages/light/tables/coat_table.hpp"
#include "runtime/stages/light/tables/glass_table.hpp"

namespace voxelume {
namespace {

void copy(const glm::vec3& from, float (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

// The positions of hits are rounded to this part of the longest way through the world, or less.
constexpr double kPositionRounding = 0x1p-20;

/// Sets a checker. A face on the border of two blocks shows the upper block everywhere, wherever
/// rounding puts its points.
void set_checker(const Checker& checker, const GridFrame& world, MaterialRecord& record) {
    copy(checker.color, record.checker_color);
    const int longest = std::max({world.size.x, world.size.y, world.size.z});
    for (int a = 0; a < 3; ++a) {
        if (checker.size[a] == 0) continue;
        record.checker_scale[a] = float(world.voxel_edge[a] / checker.size[a]);
        // Two blocks make a period. Far from the origin a float would lose whole blocks to
        // rounding.
        const double shift = (world.origin[a] - checker.origin[a]) / checker.size[a];
        const double rounding = kPositionRounding * longest * record.checker_scale[a];
        record.checker_shift[a] = float(std::fmod(shift, 2.0) + rounding);
    }
}

double coat_width_of(const Material& material) {
    return width_of(material.coat_roughness.value_or(kCoatRoughness));
}

/// The reflectance of the facets of a material's non-metallic part.
struct Reflectance {
    double straight, grazing;
};

Reflectance reflectance_of(const Material& material) {
    const double ior = material.ior, all = material.specular.value_or(1);
    return {all * (ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)), all};
}

/// A physically based material's record, to which Whitted's model adds nothing. `means` are those
/// of its facets.
MaterialRecord physical_record(const Material& material, const GridFrame& world,
                               const AlbedoMeans& means) {
    Material plain = material;
    plain.color = color_of(material);
    const double glass = glass_share(material);
    plain.diffuse = plain.reflection = plain.shininess = 0;
    plain.specular = 0;
    plain.refraction = float(glass);
    plain.fresnel = false;
    MaterialRecord record = material_record(plain, world);
    // Layers belong to the part that isn't glass.
    record.metallic = glass < 1 ? float(material.metallic.value_or(0) / (1 - glass)) : 0;
    record.width = float(width_of(material.roughness.value_or(kRoughness)));
    const Reflectance reflectance = reflectance_of(material);
    record.reflectance = float(reflectance.straight);
    record.missing = float(means.missing);
    record.matt = float((1 - double(record.metallic)) /
                        passed_share(record.reflectance, means, reflectance.grazing));
    return record;
}

/// The index of refraction by which facets bend light; an index without effect becomes a small one.
double glass_index(double ior) {
    constexpr double kMin = 1e-3;
    return std::abs(ior - 1) < kMin ? 1 + kMin : ior;
}

/// The block of a material's glass.
std::array<float, VXL_GLASS_FLOATS> glass_block(double width, double ior) {
    const GlassTable table = glass_table(width, ior);
    std::array<float, VXL_GLASS_FLOATS> block{};
    block[VXL_GLASS_IOR] = float(ior);
    for (size_t side = 0; side < 2; ++side) {
        block[VXL_GLASS_BACK + side] = float(table.back[side]);
        block[VXL_GLASS_PER_MISSING + side] = float(1 / table.missing[side]);
    }
    std::ranges::copy(table.values, block.begin() + VXL_GLASS_TABLE);
    return block;
}

/// The block of a material with a coat, or of one without whose facets reflect less than its index
/// implies. `albedos` is the number of the first value of the coat's table.
std::array<float, VXL_COAT_FLOATS> coat_block(const Material& material, double width,
                                              double albedos) {
    std::array<float, VXL_COAT_FLOATS> block{};
    block[VXL_COAT_REFLECTS] = float(reflectance_of(material).grazing);
    block[VXL_COAT_PER_ENTERED] = 1;
    const double share = material.coat.value_or(0);
    if (share == 0) return block;
    const double coat_width = coat_width_of(material);
    const AlbedoTable facets = albedo_table(coat_width);
    const CoatTable table = coat_table(coat_width, width);
    block[VXL_COAT_SHARE] = float(share);
    block[VXL_COAT_WIDTH] = float(coat_width);
    block[VXL_COAT_ALBEDOS] = float(albedos);
    block[VXL_COAT_LATER] = float(coat_later(facets));
    block[VXL_COAT_PER_MISSING] = float(1 / facets.missing);
    block[VXL_COAT_PER_ENTERED] = float(1 / (1 - share * table.returned));
    std::ranges::copy(table.values, block.begin() + VXL_COAT_TABLE);
    return block;
}

/// Records of materials, followed by the tables.
class RecordList {
  public:
    RecordList(const Scene& scene, const GridFrame& world, bool has_maps)
        : world_(world), before_(scene.materials.size()), has_maps_(has_maps) {}

    void add_whitted(const Material& material) {
        MaterialRecord record = material_record(whitted_material(material), world_);
        const MetalTint tint = metal_tint(material);
        record.albedos = float(tint.highlight);
        record.missing = float(tint.mirror);
        if (has_maps_ && takes_gloss_map(material)) {
            record.metallic = float(material.metallic.value_or(0));
            record.width = float(std::max(material.roughness.value_or(kRoughness), 1e-6));
            record.reflectance = float(material.specular.value_or(1));
        }
        records_.push_back(record);
    }

    void add_physical(const Material& material) {
        const double width = width_of(material.roughness.value_or(kRoughness));
        const double share = material.coat.value_or(0);
        const AlbedoTable table = albedo_table(width);
        AlbedoMeans means{table.missing, table.by_angle};
        if (share > 0)
            means = means_under_coat(means, coat_table(coat_width_of(material), width), share);
        MaterialRecord record = physical_record(material, world_, means);
        record.albedos = albedos(width);
        if (glass_share(material) > 0) record.shininess = glass(width, glass_index(material.ior));
        if (share > 0 || material.specular.value_or(1) < 1) record.specular = coat(material, width);
        if (has_maps_ && takes_gloss_map(material)) record.fresnel = all_roughnesses();
        records_.push_back(record);
    }

    std::vector<MaterialRecord> take() {
        records_.insert(records_.end(), tables_.begin(), tables_.end());
        return std::move(records_);
    }

  private:
    /// Appends floats as records of tables. Returns the number of their first float in the array of
    /// all materials, in which `before_` records precede the tables.
    float add_table(std::span<const float> values) {
        const size_t first = tables_.size();
        tables_.resize(first + values.size_bytes() / sizeof(MaterialRecord));
        std::memcpy(&tables_[first], values.data(), values.size_bytes());
        return float((before_ + first) * VXL_MATERIAL_FLOATS);
    }
    float albedos(double width) {
        const auto [found, is_new] = albedos_.try_emplace(width);
        if (is_new) found->second = add_table(albedo_table(width).values);
        return found->second;
    }
    float glass(double width, double ior) {
        const auto [found, is_new] = glasses_.try_emplace({width, ior});
        if (is_new) found->second = add_table(glass_block(width, ior));
        return found->second;
    }
    /// The tables of VXL_MATERIAL_MAPPED.
    float all_roughnesses() {
        if (all_roughnesses_ > 0) return all_roughnesses_;
        std::vector<float> values, means;
        for (int i = 0; i < VXL_ROUGHNESS_STEPS; ++i) {
            const AlbedoTable table = albedo_table(width_of(double(i) / (VXL_ROUGHNESS_STEPS - 1)));
            means.insert(means.end(), {float(table.missing), float(table.by_angle)});
            values.insert(values.end(), table.values.begin(), table.values.end());
        }
        values.insert(values.begin(), means.begin(), means.end());
        return all_roughnesses_ = add_table(values);
    }
    float coat(const Material& material, double width) {
        const bool is_coated = material.coat.value_or(0) > 0;
        return add_table(
            coat_block(material, width, is_coated ? albedos(coat_width_of(material)) : 0));
    }

    const GridFrame& world_;
    size_t before_;
    bool has_maps_;
    float all_roughnesses_ = 0;
    std::vector<MaterialRecord> records_, tables_;
    std::map<double, float> albedos_;  // one table for each width
    std::map<std::pair<double, double>, float> glasses_;
};

}  // namespace

MaterialRecord material_record(const Material& material, const GridFrame& world) {
    MaterialRecord record{};
    copy(material.color, record.color);
    copy(material.absorption, record.absorption);
    copy(material.emission, record.emission);
    record.diffuse = material.diffuse;
    record.specular = float(material.specular.value_or(0));
    record.shininess = material.shininess;
    record.reflection = material.reflection;
    record.refraction = material.refraction;
    record.ior = material.ior;
    record.opacity = material.opacity;
    record.fresnel = material.fresnel ? 1.0f : 0.0f;
    copy(material.color, record.checker_color);
    if (material.checker) set_checker(*material.checker, world, record);
    return record;
}

std::vector<MaterialRecord> material_records(const Scene& scene, const GridFrame& world,
                                             const Features& features) {
    RecordList list(scene, world, features.texture_maps);
    for (const Material& material : scene.materials)
        if (features.physical && is_physical(material))
            list.add_physical(material);
        else
            list.add_whitted(material);
    return list.take();
}

}  // namespace voxelume
