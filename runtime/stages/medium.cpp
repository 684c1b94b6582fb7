#include "runtime/stages/medium.hpp"

#include "runtime/stages/trace.hpp"

namespace voxelume {

MediumStage::MediumStage(const Device& device, const Features& features, const Space& space)
    : space_(space),
      program_(device, "medium.cl", features.defines(device)),
      sight_(program_.kernel("absorb_sight")) {}

void MediumStage::sight(const Pyramid& pyramid, RayBatch& batch, uint32_t count) {
    sight_.launch_packets(count, shape_of(pyramid), space_, batch.rays, batch.hits, count,
                          batch.stride, batch.radiance);
}

}  // namespace voxelume
