// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/medium/medium.hpp"

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

Environment with_scattering(Environment environment, const MediumScattering& scattering) {
    if (!scattering.value) return environment;
    environment.absorption.x += scattering.value->x;
    environment.absorption.y += scattering.value->y;
    environment.absorption.z += scattering.value->z;
    return environment;
}

}  // namespace

MediumStage::MediumStage(const Device& device, const Features& features, const World& world,
                         const Environment& environment, const Buffer<MaterialRecord>& materials,
                         const std::vector<Light>& lights)
    : environment_(environment),
      scattering_(scattering_of(features, world.medium)),
      extinction_(with_scattering(environment, scattering_)),
      materials_(materials),
      density_(features.medium_grid ? form_density_grid(device, world, lights) : DensityGrid{}),
      program_(device, "medium.cl", features.defines(device)),
      camera_(program_.kernel("absorb_sight")),
      shadows_(program_.kernel("absorb_shadows")) {}

void MediumStage::sight(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    camera_.launch_packets(count, shape_of(pyramid), environment_, scattering_, density_,
                           density_.colors, materials_, batch, count);
}

void MediumStage::shadows(const Pyramid& pyramid, ShadowQueue& queue, uint32_t maximum,
                          RayBatch& batch) {
    shadows_.launch_packets(maximum, shape_of(pyramid), extinction_, density_, queue, batch);
}

}  // namespace voxelume
