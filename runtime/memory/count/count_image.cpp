// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/count_image.hpp"

#include <algorithm>
#include <bit>

#include "runtime/analysis/scene_features.hpp"
#include "runtime/analysis/scene_lights.hpp"
#include "runtime/grid/sector_table.hpp"
#include "runtime/scene/first_samples.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene/rendered_channels.hpp"
#include "runtime/stages/light/emitters.hpp"
#include "runtime/stages/light/light.hpp"
#include "runtime/stages/light/light_beams.hpp"
#include "runtime/stages/light/sky_map.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

/// The maximum bytes of counters and samples' tables, and of the records of a material or object.
constexpr size_t kSmallTables = 8192, kRecordBytes = 160;

/// Follows Illumination::send_beams. Emissive objects are in the world, and send none.
std::vector<Buffer<float>> count_light_beams(const Device& device, const Scene& scene,
                                             const Pyramid& world, DilationLevel of,
                                             uint32_t maximum) {
    std::vector<LightRecord> lights = given_lights(scene, world.frame);
    std::erase_if(lights, [&](const LightRecord& light) { return !may_light(light, world.frame); });
    std::vector<Buffer<float>> beams;
    for (const BeamGrid& grid :
         beam_grids(lights, world.frame.size, scale_of(of), maximum, kLightsOfMaxBeams * maximum))
        beams.push_back(allocate_light_beams(device, grid));
    return beams;
}

}  // namespace

Buffer<uint8_t> count_tables(const Device& device, const Scene& scene) {
    const size_t records = scene.materials.size() + scene.objects.size();
    return {device, "small tables", kSmallTables + kRecordBytes * records};
}

DilatedOccupancy count_dilated_occupancy(const Device& device, const Pyramid& world,
                                         DilationLevel of) {
    const glm::dvec3 table(of == DilationLevel::leaves ? world.frame.sectors()
                                                       : (world.frame.sectors() + 3) / 4);
    const double slots = table.x * table.y * table.z;
    const size_t whole = world.bricks.size() / kWordsPerRecord / kRecordsPerSector;
    const double records = double(whole);
    const double stored = (of == DilationLevel::leaves ? records : records / 16);
    DilatedOccupancy dilated_occupancy =
        allocate_dilated_occupancy(device, size_t(slots), size_t(std::min(slots, stored + 1)));
    dilated_occupancy.of = of;
    return dilated_occupancy;
}

/// The maximum number of emissive voxels in a world: those of all models of emissive instances, and
/// the world's own, without the models that are joined to them.
size_t count_shining(const Scene& scene, const Pyramid& world) {
    const InstanceSet& instances = world.instances;
    size_t of_models = 0, shining = 0;
    for (const size_t records : instances.counted) of_models += records;
    const auto shines_in_world = [&](const Object& object) {
        return is_emissive(scene, object) && !is_instanced(scene, object);
    };
    if (std::ranges::any_of(scene.objects, shines_in_world))
        shining = world.records() - std::min<size_t>(of_models, world.records());
    for (const Instance& instance : instances.list)
        if (is_emissive(scene, scene.objects[instance.object]))
            shining += instances.counted[instance.model];
    return shining;
}

/// The maximum memory of a world's emitters, as if all those voxels were emissive.
void count_emitters(const Device& device, const Scene& scene, const Pyramid& world,
                    ImageMemory& memory) {
    const size_t shining = count_shining(scene, world);
    const size_t emitters = std::min(shining, kMaxEmitters);
    const size_t bytes = emitters * sizeof(EmitterRecord) + std::bit_ceil(2 * emitters + 1) * 4 +
                         (world.instances.list.size() + 1) * sizeof(EmitterFrame);
    memory.emitters = {device, "emitters", bytes};
    memory.emitter_host_bytes = emitter_host_bytes(shining, world.records());
}

/// Counts the picture of a sky.
void count_sky(const Device& device, const Sky& sky, ImageMemory& memory) {
    const SkyMapBytes bytes = sky_map_bytes(sky);
    memory.sky_texels = {device, "sky", size_t(bytes.texels)};
    memory.sky_table = {device, "sky", size_t(bytes.table)};
    memory.sky_host_bytes = bytes.host;
}

/// Counts the image of an adaptive image's first samples; the image of the others may be as large.
void count_first_samples(const Device& device, const Scene& scene, ImageMemory& memory) {
    const RenderSettings first = first_samples_of(scene).render;
    memory.first_image = allocate_image(device, first.size, first.channels);
    memory.first_mattes = allocate_mattes(device, first.size, first.channels);
    const size_t slots = (size_t(scene.render.size.x) * size_t(scene.render.size.y) + 15) / 16;
    memory.image = allocate_image(device, {4 * int(slots), 4}, first.channels);
    memory.mattes = allocate_mattes(device, {4 * int(slots), 4}, first.channels);
    memory.chosen_pixels = {device, "chosen pixels", 16 * slots};
}

ImageMemory count_image(const Device& device, const Scene& scene, const Pyramid& world,
                        const DensityPlan& medium, size_t depth) {
    if (!scene.render.channels.color &&
        (scene.render.channels.has_passes() || adds_color(scene.render))) {
        Scene lit = scene;  // with the light of the image or of its passes
        lit.render.channels.color = true;
        return count_image(device, lit, world, medium, depth);
    }
    const Features features = features_of(scene, world);
    const Camera camera = camera_of(scene, world.frame);
    const uint64_t rays =
        16ull * tile_count(camera.width, camera.height) * uint64_t(camera.samples);
    const double pixel = voxels_a_pixel(scene, camera, world.frame);
    RayCounts counts = ray_counts(device, scene, features);
    counts.depth = std::min(counts.depth, depth);
    ImageMemory memory;
    memory.rays = allocate_rays(device, features, counts);
    memory.tables = count_tables(device, scene);
    if (features.chosen_lights) {
        for (const auto& lights : chosen_lights_of(scene, world.frame)) {
            memory.light_trees.push_back(
                allocate_light_tree(device, lights.size(), lights.front().area.has_value()));
            memory.light_tree_host_bytes += light_tree_host_bytes(lights.size());
        }
    }
    if (features.emitters != VXL_EMITTERS_NONE) count_emitters(device, scene, world, memory);
    if (features.sky == VXL_SKY_MAP) count_sky(device, *scene.world.sky, memory);
    if (const auto of = dilation_that_pays(features, world, rays, pixel)) {
        memory.dilated_occupancy = count_dilated_occupancy(device, world, *of);
        memory.beams = allocate_beams(device, counts.rays);
        if (counts.is_lit && lights_send_beams(features))
            memory.light_beams =
                count_light_beams(device, scene, world, *of,
                                  light_beams_that_pay(world.frame, rays, camera.samples, pixel));
    }
    if (features.medium_grid) memory.density = allocate_density(device, medium.size);
    memory.image = allocate_image(device, scene.render.size, scene.render.channels);
    memory.mattes = allocate_mattes(device, scene.render.size, scene.render.channels,
                                    scene.render.all_samples > 0);
    if (is_adaptive(scene.render)) count_first_samples(device, scene, memory);
    return memory;
}

}  // namespace voxelume
