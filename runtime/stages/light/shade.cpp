// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/shade.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstring>
#include <map>
#include <numeric>
#include <span>
#include <utility>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/float4.hpp"
#include "runtime/stages/light/albedo_table.hpp"
#include "runtime/stages/light/glass_table.hpp"
#include "runtime/stages/light/sky_light.hpp"
#include "runtime/stages/light/sky_map.hpp"

namespace voxelume {
namespace {

void copy(const glm::vec3& from, float (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

/// A physically based material's record, which Whitted's model adds nothing to.
MaterialRecord physical_record(const Material& material, const GridFrame& world,
                               const AlbedoTable& table) {
    Material plain = material;
    plain.color = color_of(material);
    const double glass = glass_share(material), ior = material.ior;
    plain.diffuse = plain.specular = plain.reflection = plain.shininess = 0;
    plain.refraction = float(glass);
    plain.fresnel = false;
    MaterialRecord record = material_record(plain, world);
    // The layers are those of what isn't glass.
    record.metallic = glass < 1 ? float(material.metallic.value_or(0) / (1 - glass)) : 0;
    record.width = float(width_of(material.roughness.value_or(kRoughness)));
    record.reflectance = float((ior - 1) * (ior - 1) / ((ior + 1) * (ior + 1)));
    record.missing = float(table.missing);
    record.matt = float((1 - double(record.metallic)) / passed_share(record.reflectance, table));
    return record;
}

/// An index of refraction by which facets bend light; those of no effect become a small one.
double glass_index(double ior) {
    constexpr double kLeast = 1e-3;
    return std::abs(ior - 1) < kLeast ? 1 + kLeast : ior;
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

/// Adds floats as records of tables. Returns the number of the first in the array of all materials,
/// of which so many records come before the tables.
float add_table(std::span<const float> values, size_t before, std::vector<MaterialRecord>& tables) {
    const size_t first = tables.size();
    tables.resize(first + values.size_bytes() / sizeof(MaterialRecord));
    std::memcpy(&tables[first], values.data(), values.size_bytes());
    return float((before + first) * VXL_MATERIAL_FLOATS);
}

/// The records of all materials, and behind them the tables of those that are physically based, of
/// which those of one width have one.
std::vector<MaterialRecord> material_records(const Scene& scene, const GridFrame& world,
                                             bool has_physical) {
    std::vector<MaterialRecord> records, tables;
    std::map<double, std::pair<AlbedoTable, float>> known;
    std::map<std::pair<double, double>, float> known_glass;
    const size_t before = scene.materials.size();
    for (const Material& material : scene.materials) {
        if (!has_physical || !is_physical(material)) {
            records.push_back(material_record(whitted_material(material), world));
            continue;
        }
        const double width = width_of(material.roughness.value_or(kRoughness));
        const auto [found, is_new] = known.try_emplace(width);
        auto& [table, first] = found->second;
        if (is_new) {
            table = albedo_table(width);
            first = add_table(table.values, before, tables);
        }
        records.push_back(physical_record(material, world, table));
        records.back().albedos = first;
        if (glass_share(material) == 0) continue;
        const double ior = glass_index(material.ior);
        const auto [block, is_new_glass] = known_glass.try_emplace({width, ior});
        if (is_new_glass) block->second = add_table(glass_block(width, ior), before, tables);
        records.back().shininess = block->second;
    }
    records.insert(records.end(), tables.begin(), tables.end());
    return records;
}

void set_checker(const Checker& checker, const GridFrame& world, MaterialRecord& record) {
    copy(checker.color, record.checker_color);
    for (int a = 0; a < 3; ++a) {
        if (checker.size[a] == 0) continue;
        record.checker_scale[a] = float(world.voxel_edge[a] / checker.size[a]);
        // Two blocks make a period. Far from the origin a float would lose whole blocks to
        // rounding.
        const double shift = (world.origin[a] - checker.origin[a]) / checker.size[a];
        record.checker_shift[a] = float(std::fmod(shift, 2.0));
    }
}

/// The rank of each object by descending priority; of equal priorities the earlier object comes
/// first.
std::vector<uint32_t> object_ranks(const std::vector<Object>& objects) {
    std::vector<uint32_t> order(objects.size());
    std::iota(order.begin(), order.end(), 0u);
    std::ranges::stable_sort(
        order, [&](uint32_t a, uint32_t b) { return objects[a].priority > objects[b].priority; });
    std::vector<uint32_t> ranks(objects.size());
    for (uint32_t rank = 0; rank < order.size(); ++rank) ranks[order[rank]] = rank;
    return ranks;
}

}  // namespace

MaterialRecord material_record(const Material& material, const GridFrame& world) {
    MaterialRecord record{};
    copy(material.color, record.color);
    copy(material.absorption, record.absorption);
    copy(material.emission, record.emission);
    record.diffuse = material.diffuse;
    record.specular = material.specular;
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

Environment environment_of(const World& world) {
    return {to_float4(glm::dvec3(world.background)), to_float4(glm::dvec3(world.ambient)),
            to_float4(glm::dvec3(world.medium.absorption)),
            to_float4(glm::dvec3(world.medium.color))};
}

ShadeStage::ShadeStage(const Device& device, const Features& features, const Scene& scene,
                       const GridFrame& world)
    : environment_(environment_of(scene.world)),
      materials_(
          device, "materials",
          std::span<const MaterialRecord>(material_records(scene, world, features.physical))),
      sky_is_hidden_(features.sky_hidden),
      program_(device, "shade.cl", features.defines(device)),
      surface_(program_.kernel("shade_surface")) {
    if (features.sky == VXL_SKY_MAP) {
        sky_.map = build_sky_map(device, *scene.world.sky);
    } else if (features.sky != VXL_SKY_NONE) {
        const SkyRecord record = sky_record(*scene.world.sky);
        sky_.record = Buffer<SkyRecord>(device, "sky", std::span<const SkyRecord>(&record, 1));
    }
    if (features.textures) footprint_.footprint = footprint_of(scene, world);
    if (features.global) environment_.ambient = {};  // it stands for light that paths find
    if (features.paths)
        ranks_ = Buffer<uint32_t>(device, "ranks",
                                  std::span<const uint32_t>(object_ranks(scene.objects)));
}

void ShadeStage::surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count,
                         bool from_observer) {
    if (sky_is_hidden_)
        surface_.launch_packets(count, pyramid, environment_, sky_, uint32_t(from_observer),
                                emitters_, footprint_, materials_, ranks_, batch, count);
    else
        surface_.launch_packets(count, pyramid, environment_, sky_, emitters_, footprint_,
                                materials_, ranks_, batch, count);
}

}  // namespace voxelume
