// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/area_light.hpp"

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {

AreaLightStage::AreaLightStage(const Device& device, const Features& features,
                               const Buffer<MaterialRecord>& materials)
    : materials_(materials),
      program_(device, "area_light.cl", features.defines(device)),
      add_(program_.kernel("add_area_light")) {
    if (!features.meets_lights) return;
    meet_.emplace(program_.kernel("meet_area_light"));
    if (features.chosen_areas) meet_all_.emplace(program_.kernel("meet_area_lights"));
}

void AreaLightStage::add(const Pyramid& pyramid, const LightRecord& light,
                         const LightAreaRecord& area, const PathSampling& sampling, uint32_t number,
                         RayBatch& batch, uint32_t count, ShadowQueue& queue) {
    if (!queue.count.empty()) queue.count.fill(0);
    add_.launch_packets(count, pyramid, light, area, sampling, number, materials_, queue, batch,
                        count);
}

void AreaLightStage::meet(const Pyramid& pyramid, const LightRecord& light,
                          const LightAreaRecord& area, const Surroundings& surroundings,
                          RayBatch& batch, uint32_t count, NodeLight& nodes) {
    meet_->launch_packets(count, shape_of(pyramid), light, area, surroundings, batch, count, nodes);
}

void AreaLightStage::meet_all(const Pyramid& pyramid, const LightTree& lights,
                              const Surroundings& surroundings, RayBatch& batch, uint32_t count,
                              NodeLight& nodes) {
    meet_all_->launch_packets(count, shape_of(pyramid), lights, surroundings, batch, count, nodes);
}

}  // namespace voxelume
