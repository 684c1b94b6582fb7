#include "runtime/stages/medium/medium.hpp"

#include "runtime/stages/trace/trace.hpp"

namespace voxelume {

MediumStage::MediumStage(const Device& device, const Features& features, const World& world,
                         const Space& space, const Buffer<MaterialRecord>& materials)
    : space_(space),
      materials_(materials),
      density_(features.medium_grid ? form_density_grid(device, world) : DensityGrid{}),
      program_(device, "medium.cl", features.defines(device)),
      sight_(program_.kernel("absorb_sight")),
      shadows_(program_.kernel("absorb_shadows")) {}

void MediumStage::sight(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    sight_.launch_packets(count, shape_of(pyramid), space_, density_.shape, density_.bricks,
                          density_.values, materials_, batch.rays, batch.hits, batch.starts,
                          batch.inside, count, batch.stride, batch.radiance, batch.passed);
}

void MediumStage::shadows(const Pyramid& pyramid, ShadowQueue& queue, uint32_t most,
                          RayBatch& batch) {
    shadows_.launch_packets(most, shape_of(pyramid), space_, density_.shape, density_.bricks,
                            density_.values, queue.rays, queue.count, batch.stride, queue.targets,
                            queue.shares, batch.radiance);
}

}  // namespace voxelume
