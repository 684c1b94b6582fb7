#include "runtime/stages/shade.hpp"

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
    record.opacity = material.opacity;
    record.fresnel = material.fresnel ? 1.0f : 0.0f;
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
      surface_(program_.kernel("shade_surface")) {}

void ShadeStage::surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    surface_.launch_packets(count, shape_of(pyramid), space_, materials_, pyramid.attributes,
                            pyramid.attribute, pyramid.colors, pyramid.fields, pyramid.triangles,
                            pyramid.triangle_attributes, pyramid.solids, batch.rays, batch.hits,
                            count, batch.stride, batch.positions, batch.normals, batch.words,
                            batch.radiance);
}

}  // namespace voxelume
