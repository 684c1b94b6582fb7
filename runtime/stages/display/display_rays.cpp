// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/display/display_rays.hpp"

#include <algorithm>

#include "runtime/base/error.hpp"
#include "runtime/stages/display/display_layers.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"
#include "runtime/stages/trace/sight.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kSpanComponents = 3;
constexpr size_t kMaxAmounts = 1 << 23;  ///< number of steps of rays whose density is measured
                                         ///< together

uint32_t ray_count(const Camera& camera) {
    return tile_count(camera.width, camera.height) * 16;
}

/// Replaces each count by the sum of those before it. Returns the sum of all.
uint64_t make_starts(std::vector<uint32_t>& counts) {
    uint64_t sum = 0;
    for (uint32_t& count : counts) {
        const uint32_t here = count;
        count = uint32_t(sum);
        sum += here;
    }
    return sum;
}

}  // namespace

void bind(KernelArguments& to, const VoxelArrays& voxels) {
    to.add(voxels.indices, voxels.colors, voxels.opacities, voxels.depths, voxels.objects);
}

void bind(KernelArguments& to, const RayDepths& depths) {
    to.add(depths.steps, depths.depths, depths.objects, depths.colors, depths.spans, depths.total);
}

RayDepths allocate_ray_depths(const Device& device, const Features& features, uint32_t total) {
    RayDepths rays;
    rays.total = total;
    rays.steps = Buffer<uint32_t>(device, "display steps", total);
    rays.objects = Buffer<uint32_t>(device, "display ray objects", total);
    rays.depths = Buffer<float>(device, "display ray depths", total);
    rays.colors = Buffer<float>(device, "display ray colors", size_t(total) * 3);
    if (features.medium)
        rays.spans = Buffer<float>(device, "display spans", size_t(total) * kSpanComponents);
    return rays;
}

VoxelArrays allocate_voxels(const Device& device, uint64_t count) {
    if (count >= UINT32_MAX)
        throw Error(ErrorKind::limit,
                    "this volumetric image has {} voxels, at most {} can be numbered: use larger "
                    "display voxels, or no medium",
                    count, UINT32_MAX - 1);
    const size_t padded = (size_t(count) + 15) / 16 * 16;
    VoxelArrays voxels;
    voxels.count = size_t(count);
    voxels.indices = Buffer<uint64_t>(device, "display indices", padded);
    voxels.colors = Buffer<float>(device, "display colors", padded * 3);
    voxels.opacities = Buffer<float>(device, "display opacities", padded);
    voxels.depths = Buffer<float>(device, "display depths", padded);
    voxels.objects = Buffer<uint32_t>(device, "display objects", padded);
    return voxels;
}

void read_voxels(const VoxelArrays& voxels, Volume& volume) {
    volume.indices = voxels.indices.read(0, voxels.count);
    volume.opacities = voxels.opacities.read(0, voxels.count);
    volume.depths = voxels.depths.read(0, voxels.count);
    volume.objects = voxels.objects.read(0, voxels.count);
    const std::vector<float> colors = voxels.colors.read(0, voxels.count * 3);
    volume.colors.resize(voxels.count);
    volume.kinds.resize(voxels.count);
    for (size_t i = 0; i < voxels.count; ++i) {
        volume.colors[i] = {colors[3 * i], colors[3 * i + 1], colors[3 * i + 2]};
        volume.kinds[i] = volume.objects[i] == 0 ? VoxelKind::space : VoxelKind::object;
    }
}

uint32_t display_batch_tiles(const Device& device, const Features& features, uint32_t tiles) {
    constexpr uint32_t kLayerTiles = 4096;
    const uint32_t most = batch_tiles(device, features, 1, tiles);
    return features.own_light ? std::min(most, kLayerTiles) : most;
}

DisplayRaysStage::DisplayRaysStage(const Device& device, const Features& features,
                                   const Camera& camera, const VolumeFrame& frame,
                                   const Medium& medium, const Environment& environment)
    : device_(device),
      has_layers_(features.transmission || features.medium_grid),
      adds_layers_(features.transmission && !features.own_light),
      medium_colors_(features.medium_colors),
      camera_(camera),
      steps_(display_steps(frame, medium)),
      near_depth_(float(frame.display.near)),
      environment_(environment),
      rays_(allocate_ray_depths(device, features, ray_count(camera))),
      program_(device, has_layers_ ? "display/display_layers.cl" : "display/display_rays.cl",
               features.defines(device)) {
    if (!features.medium) steps_.absorption = 0;
    if (has_layers_) {
        layer_ = program_.kernel("measure_layer");
        density_ = program_.kernel("measure_density");
    } else {
        measure_ = program_.kernel("measure_steps");
        count_ = program_.kernel("count_voxels");
        place_ = program_.kernel("place_voxels");
        fill_ = program_.kernel("fill_voxels");
    }
}

void DisplayRaysStage::keep(const PyramidShape& world, const RayBatch& batch, uint32_t first_ray,
                            uint32_t count) {
    measure_.value().launch_packets(count, camera_, world, steps_, batch, count, first_ray, rays_);
}

void DisplayRaysStage::keep_layer(const Pyramid& world, const DensityGrid* density,
                                  const Layer& layer) {
    const auto& [entries, count, is_first, nodes, first_ray] = layer;
    if (adds_layers_ && seen_.size() < size_t(nodes.stride) * 4)
        seen_ = Buffer<float>(device_, "display layers", size_t(nodes.stride) * 4);
    const Buffer<uint32_t> words(device_, "display layers", size_t(count) * VXL_LAYER_WORDS);
    layer_.value().launch(WorkItem::light, count, camera_, shape_of(world), steps_,
                          uint32_t(is_first), entries, count, nodes, first_ray, seen_, words);
    LayerRecords records{count, words.read(), {}, {}, {}, {}};
    if (density) measure_density(world, *density, layer, records);
    layers_.push_back(std::move(records));
}

/// Measures a few entries at a time, since each step of a ray takes memory, with or without medium.
void DisplayRaysStage::measure_density(const Pyramid& world, const DensityGrid& density,
                                       const Layer& layer, LayerRecords& records) {
    const auto steps = size_t(steps_.count);
    const size_t planes = medium_colors_ ? 4 : 1;
    const uint32_t maximum = std::max(uint32_t(kMaxAmounts / steps / planes) / 16, 1u) * 16;
    const size_t plane = maximum * steps;
    Buffer<float> amounts(device_, "display amounts", planes * plane);
    for (uint32_t first = 0; first < layer.count; first += maximum) {
        const uint32_t now = std::min(maximum, layer.count - first);
        amounts.fill(0);
        density_.value().launch_packets(
            now, camera_, shape_of(world), steps_, SpaceMedium{environment_, density},
            uint32_t(layer.is_first), layer.entries, first, now, maximum, amounts);
        const std::vector<float> dense = amounts.read();
        for (uint32_t n = 0; n < now; ++n) {
            size_t begin = 0, end = steps;
            while (begin < end && dense[begin * maximum + n] == 0) ++begin;
            while (end > begin && dense[(end - 1) * maximum + n] == 0) --end;
            records.first_step.push_back(uint32_t(begin));
            records.first_amount.push_back(records.amounts.size());
            for (size_t k = begin; k < end; ++k) {
                const size_t at = k * maximum + n;
                records.amounts.push_back(dense[at]);
                if (medium_colors_)
                    records.lights.emplace_back(dense[plane + at], dense[2 * plane + at],
                                                dense[3 * plane + at]);
            }
        }
    }
    records.first_amount.push_back(records.amounts.size());
}

void DisplayRaysStage::read(Volume& volume) {
    if (has_layers_)
        assemble_layers(layers_, {steps_, environment_, near_depth_}, volume);
    else
        read_voxels(voxels(), volume);
}

VoxelArrays DisplayRaysStage::voxels() {
    const uint32_t width = uint32_t(camera_.width), height = uint32_t(camera_.height);
    Buffer<uint32_t> starts(device_, "display counts", size_t(height) * size_t(steps_.count));
    starts.fill(0);
    count_.value().launch(WorkItem::heavy, height, width, height, steps_, rays_, starts);
    std::vector<uint32_t> counts = starts.read();
    VoxelArrays voxels = allocate_voxels(device_, make_starts(counts));
    if (voxels.count == 0) return voxels;
    starts.write(std::span<const uint32_t>(counts));
    place_.value().launch(WorkItem::heavy, height, width, height, steps_, rays_, starts,
                          voxels.indices, voxels.objects);
    const uint32_t count = uint32_t(voxels.count);
    fill_.value().launch_packets(count, width, height, steps_, near_depth_, environment_, rays_,
                                 count, voxels);
    return voxels;
}

}  // namespace voxelume
