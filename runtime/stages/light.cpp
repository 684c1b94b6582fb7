#include "runtime/stages/light.hpp"

#include <cmath>

#include "runtime/stages/float4.hpp"
#include "runtime/stages/trace.hpp"

namespace voxelume {
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

LightStage::LightStage(const Device& device, const Features& features,
                       const Buffer<MaterialRecord>& materials)
    : materials_(materials),
      program_(device, "light.cl", features.defines(device)),
      add_(program_.kernel("add_light")) {}

void LightStage::add(const Pyramid& pyramid, const LightRecord& light, RayBatch& batch,
                     uint32_t count, ShadowQueue& queue) {
    if (!queue.count.empty()) queue.count.fill(0);
    add_.launch_packets(count, shape_of(pyramid), light, materials_, pyramid.colors, batch.rays,
                        batch.hits, count, batch.stride, batch.positions, batch.normals,
                        batch.words, batch.sides, batch.radiance, queue.count, queue.rays,
                        queue.targets, queue.sources, queue.shares);
}

}  // namespace voxelume
