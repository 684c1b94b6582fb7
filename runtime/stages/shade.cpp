#include "runtime/stages/shade.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/stages/trace.hpp"

namespace voxelume {
namespace {

float4 to_float4(const glm::dvec3& v) {
    return {float(v.x), float(v.y), float(v.z), 0};
}

void copy(const glm::vec3& from, float (&to)[3]) {
    for (int i = 0; i < 3; ++i) to[i] = from[i];
}

std::vector<MaterialRecord> material_records(const Scene& scene) {
    std::vector<MaterialRecord> records;
    for (const Material& material : scene.materials) records.push_back(material_record(material));
    return records;
}

}  // namespace

LightRecord light_record(const Light& light, const GridFrame& world) {
    LightRecord record{};
    const bool directional = light.kind == LightKind::directional;
    record.position = to_float4(directional ? -light.direction / world.voxel_edge
                                            : (light.position - world.origin) / world.voxel_edge);
    record.direction = to_float4(light.direction);
    record.energy = to_float4(glm::dvec3(light.energy));
    record.inner_cosine = float(std::cos(light.inner_half_angle));
    record.outer_cosine = float(std::cos(light.outer_half_angle));
    record.kind = directional                     ? VXL_LIGHT_DIRECTIONAL
                  : light.kind == LightKind::spot ? VXL_LIGHT_SPOT
                                                  : VXL_LIGHT_POINT;
    return record;
}

MaterialRecord material_record(const Material& material) {
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
    return record;
}

Space space_of(const World& world) {
    return {to_float4(glm::dvec3(world.background)), to_float4(glm::dvec3(world.ambient)),
            to_float4(glm::dvec3(world.medium.absorption)),
            to_float4(glm::dvec3(world.medium.color))};
}

ShadeStage::ShadeStage(const Device& device, const Features& features, const Scene& scene)
    : space_(space_of(scene.world)),
      materials_(device, "materials", std::span<const MaterialRecord>(material_records(scene))),
      program_(device, "shade.cl", features.defines(device)),
      surface_(program_.kernel("shade_surface")),
      light_(program_.kernel("shade_light")) {}

void ShadeStage::surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    surface_.launch_packets(count, shape_of(pyramid), space_, materials_, pyramid.attributes,
                            pyramid.attribute, pyramid.colors, pyramid.fields, pyramid.triangles,
                            pyramid.triangle_attributes, pyramid.solids, batch.rays, batch.hits,
                            count, batch.stride, batch.positions, batch.normals, batch.words,
                            batch.radiance);
}

void ShadeStage::light(const Pyramid& pyramid, const LightRecord& light, RayBatch& batch,
                       uint32_t count, ShadowQueue& queue) {
    if (!queue.count.empty()) queue.count.fill(0);
    light_.launch_packets(count, shape_of(pyramid), space_, light, materials_, pyramid.colors,
                          batch.rays, batch.hits, count, batch.stride, batch.positions,
                          batch.normals, batch.words, batch.radiance, queue.count, queue.rays,
                          queue.targets, queue.sources, queue.shares);
}

}  // namespace voxelume
