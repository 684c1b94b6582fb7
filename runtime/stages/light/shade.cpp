// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/shade.hpp"

#include <span>
#include <utility>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/float4.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/material_records.hpp"
#include "runtime/stages/light/sky_light.hpp"
#include "runtime/stages/light/sky_map.hpp"

namespace voxelume {
void bind(KernelArguments& to, const SourceMeshes& sources) {
    if (!sources.words.empty()) to.add(sources.objects, sources.words);
}

void bind(KernelArguments& to, const CubeStepsArgument& argument) {
    if (!argument.steps.empty()) to.add(argument.steps);
}

namespace {

/// VXL_HIT_DETAIL_PARAMETERS of shade.cl.
struct HitDetails {
    const FootprintArgument& footprint;
    SourceMeshes sources;
    CubeStepsArgument steps;
};

void bind(KernelArguments& to, const HitDetails& details) {
    to.add(details.footprint, details.sources, details.steps);
}

}  // namespace

Environment environment_of(const World& world) {
    return {to_float4(glm::dvec3(world.background)), to_float4(glm::dvec3(world.ambient)),
            to_float4(glm::dvec3(world.medium.absorption)),
            to_float4(glm::dvec3(world.medium.color))};
}

ShadeStage::ShadeStage(const Device& device, const Features& features, const Scene& scene,
                       const GridFrame& world)
    : environment_(environment_of(scene.world)),
      materials_(device, "materials",
                 std::span<const MaterialRecord>(material_records(scene, world, features))),
      sky_is_hidden_(features.sky_hidden),
      has_sources_(features.source_meshes),
      has_cube_steps_(features.resampled_cubes),
      program_(device, "shade.cl", features.defines(device)),
      surface_(program_.kernel("shade_surface")) {
    const Outside outside = outside_of(scene);
    environment_.background = to_float4(glm::dvec3(outside.background));
    if (features.sky == VXL_SKY_MAP) {
        sky_.map = build_sky_map(device, *outside.sky);
    } else if (features.sky != VXL_SKY_NONE) {
        const SkyRecord record = sky_record(*outside.sky);
        sky_.record = Buffer<SkyRecord>(device, "sky", std::span<const SkyRecord>(&record, 1));
    }
    if (features.textures()) footprint_.footprint = footprint_of(scene, world);
    if (features.global) environment_.ambient = {};  // replaces light that paths find
    if (features.paths)
        ranks_ = Buffer<uint32_t>(device, "ranks",
                                  std::span<const uint32_t>(object_ranks(scene.objects)));
}

void ShadeStage::surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count,
                         bool from_observer) {
    const HitDetails details{footprint_,
                             has_sources_ ? pyramid.sources : SourceMeshes(),
                             {has_cube_steps_ ? pyramid.cube_steps : Buffer<float>()}};
    if (sky_is_hidden_)
        surface_.launch_packets(count, pyramid, environment_, sky_, uint32_t(from_observer),
                                emitters_, details, materials_, ranks_, batch, count);
    else
        surface_.launch_packets(count, pyramid, environment_, sky_, emitters_, details, materials_,
                                ranks_, batch, count);
}

}  // namespace voxelume
