// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/medium_paths.hpp"

#include <utility>
#include <vector>

#include "runtime/grid/grid_arguments.hpp"

namespace voxelume {
namespace {

/// The points that are chosen in a medium: VXL_MEDIUM_POINTS_PARAMETERS of kernels.
struct MediumPoints {
    const Buffer<uint32_t>& counters;
    const RayBatch& points;
};

void bind(KernelArguments& to, const MediumPoints& chosen) {
    to.add(CountedQueue{chosen.counters, chosen.points}, chosen.points.hits,
           chosen.points.radiance);
}

}  // namespace

MediumPathStage::MediumPathStage(const Device& device, const Features& features,
                                 const float4& absorption, const MediumScattering& scattering,
                                 DensityGrid density)
    : absorption_(absorption),
      scattering_(scattering),
      density_(std::move(density)),
      counters_(device, "path counters", kPathCounters),
      program_(device, "medium_paths.cl", features.defines(device)),
      scatter_(program_.kernel("scatter_in_medium")),
      add_light_(program_.kernel("add_light_to_medium")),
      extend_(program_.kernel("extend_in_medium")) {
    if (features.area_samples) add_area_light_.emplace(program_.kernel("add_area_light_to_medium"));
    if (features.chosen_lights) {
        const Program program(device, "light_tree_medium.cl", features.defines(device));
        chosen_.emplace(ChosenLightKernels{program, program.kernel("find_points_near_chosen"),
                                           program.kernel("add_chosen_light_to_medium")});
    }
    if (!features.near_light) return;
    const Program program(device, "near_light.cl", features.defines(device));
    near_.emplace(NearLightKernels{program, program.kernel("find_near_points"),
                                   program.kernel("add_near_light")});
}

uint32_t MediumPathStage::scatter(const Pyramid& pyramid, const PathSampling& sampling,
                                  RayBatch& entries, uint32_t count, RayBatch& points) {
    counters_.fill(0);
    scatter_.launch_packets(count, shape_of(pyramid), absorption_, scattering_, density_, sampling,
                            entries, count, MediumPoints{counters_, points});
    return counters_.read()[kCountChildren];
}

template <class Lights>
uint32_t MediumPathStage::find_near(Kernel& kernel, const Pyramid& pyramid, const Lights& lights,
                                    const PathSampling& sampling, bool is_first, RayBatch& entries,
                                    uint32_t count, RayBatch& points) {
    counters_.fill(0);
    kernel.launch_packets(count, shape_of(pyramid), lights, absorption_, scattering_, density_,
                          sampling, uint32_t(is_first), entries, count,
                          MediumPoints{counters_, points});
    return counters_.read()[kCountChildren];
}

uint32_t MediumPathStage::near(const Pyramid& pyramid, const LightRecord& light,
                               const PathSampling& sampling, bool is_first, RayBatch& entries,
                               uint32_t count, RayBatch& points) {
    return find_near(near_->find, pyramid, light, sampling, is_first, entries, count, points);
}

uint32_t MediumPathStage::near_chosen(const Pyramid& pyramid, const LightTree& tree,
                                      const PathSampling& sampling, bool is_first,
                                      RayBatch& entries, uint32_t count, RayBatch& points) {
    return find_near(chosen_->find, pyramid, tree, sampling, is_first, entries, count, points);
}

void MediumPathStage::add_chosen_light(const Pyramid& pyramid, const LightTree& tree,
                                       const PathSampling& sampling, bool are_near,
                                       RayBatch& points, uint32_t count, ShadowQueue& queue) {
    queue.count.fill(0);
    chosen_->add.launch_packets(count, shape_of(pyramid), tree, sampling, uint32_t(are_near),
                                scattering_, queue, points, count);
}

void MediumPathStage::add_near(RayBatch& points, uint32_t count, NodeLight& nodes) {
    near_->add.launch_packets(count, points.paths, points.radiance, points.stride, count, nodes);
}

void MediumPathStage::add_light(const Pyramid& pyramid, const LightRecord& light, RayBatch& points,
                                uint32_t count, ShadowQueue& queue) {
    queue.count.fill(0);
    add_light_.launch_packets(count, shape_of(pyramid), light, scattering_, queue, points, count);
}

void MediumPathStage::add_area_light(const Pyramid& pyramid, const LightRecord& light,
                                     const LightAreaRecord& area, const PathSampling& sampling,
                                     uint32_t number, RayBatch& points, uint32_t count,
                                     ShadowQueue& queue) {
    queue.count.fill(0);
    add_area_light_->launch_packets(count, shape_of(pyramid), light, area, sampling, number,
                                    scattering_, queue, points, count);
}

NextRays MediumPathStage::paths(const Pyramid& pyramid, const PathSampling& sampling,
                                const EmitterTable& emitters, RayBatch& points, uint32_t count,
                                NodeLight& nodes, RayQueue& next, uint32_t taken,
                                RayQueue& to_emitters) {
    counters_.fill(0);
    extend_.launch_packets(count, shape_of(pyramid), scattering_, sampling, points, count, nodes,
                           taken, CountedQueue{counters_, next},
                           SoughtLight{emitters, sky_, to_emitters});
    const std::vector<uint32_t> counts = counters_.read();
    return {counts[kCountChildren], counts[kCountToEmitters]};
}

}  // namespace voxelume
