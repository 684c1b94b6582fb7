// SPDX-License-Identifier: Apache-2.0
#include "tests/bench/trace_kernels.hpp"

#include <xxhash.h>

#include <cstring>
#include <numeric>

#include "kernels/shared/voxel.h"

namespace voxelume {
namespace {

/// The hash of the hits' t, voxels, cells and faces. For a miss only its voxel counts.
uint64_t hash_of(const RayBatch& batch, size_t count) {
    std::vector<uint32_t> words = batch.hits.read();
    uint64_t hash = 0;
    for (uint32_t c = 0; c < VXL_HIT_PRIMITIVE; ++c) {
        uint32_t* values = &words[size_t(c) * batch.stride];
        for (size_t i = 0; i < count; ++i)
            if (words[VXL_HIT_VOXEL * size_t(batch.stride) + i] == VXL_NO_VOXEL)
                values[i] = VXL_NO_VOXEL;
        hash = XXH3_64bits_withSeed(values, count * 4, hash);
    }
    return hash;
}

template <class T>
Buffer<T> filled(const Device& device, size_t size, const T& value) {
    Buffer<T> buffer(device, "bench", size);
    buffer.fill(value);
    return buffer;
}

/// The light that `split_rays` sends shadow rays to.
LightRecord light_of(const Pyramid& pyramid) {
    Light light;
    light.position = kLightPosition;
    return light_record(light, pyramid.frame);
}

}  // namespace

RayBatch batch_of(const Device& device, const Features& features, const Pyramid& pyramid,
                  const std::vector<Ray>& rays) {
    const auto count = uint32_t(rays.size());
    RayBatch batch = allocate_batch(device, features, (count + 15) / 16 * 16);
    std::vector<float> values(size_t(batch.stride) * VXL_RAY_COMPONENTS, 0.0f);
    std::fill(values.begin() + VXL_RAY_END * batch.stride, values.end(), -1.0f);
    const double unit = 1 / double(shape_of(pyramid).fixed_point);
    const double step = std::ldexp(1.0, -VXL_DIRECTION_BITS);
    for (uint32_t i = 0; i < count; ++i) {
        const glm::dvec3& d = rays[i].direction;
        int exponent = 0;
        std::frexp(std::max({std::abs(d.x), std::abs(d.y), std::abs(d.z)}), &exponent);
        for (uint32_t a = 0; a < 3; ++a) {
            values[(VXL_RAY_OX + a) * batch.stride + i] =
                float(std::round(rays[i].origin[int(a)] / unit) * unit);
            values[(VXL_RAY_DX + a) * batch.stride + i] =
                float(std::round(std::ldexp(d[int(a)], -exponent) / step) * step);
        }
        values[VXL_RAY_END * batch.stride + i] = rays[i].end;
    }
    batch.rays.write(std::span<const float>(values));
    if (!batch.paths.empty()) {
        batch.paths.fill(0);
        const std::vector<uint32_t> none(batch.stride, VXL_NO_PRIMITIVE);
        batch.paths.write(std::span<const uint32_t>(none), VXL_PATH_SOURCE * batch.stride);
    }
    return batch;
}

std::vector<Hit> hits_of(const RayBatch& batch, size_t count) {
    const std::vector<uint32_t> words = batch.hits.read();
    const std::vector<float> rays = batch.rays.read();
    std::vector<Hit> hits(count);
    for (size_t i = 0; i < count; ++i) {
        hits[i].met = words[VXL_HIT_VOXEL * batch.stride + i] != VXL_NO_VOXEL;
        std::memcpy(&hits[i].t, &words[VXL_HIT_T * batch.stride + i], 4);
        for (uint32_t a = 0; a < 3; ++a)
            hits[i].at[int(a)] =
                double(rays[(VXL_RAY_OX + a) * batch.stride + i]) +
                double(rays[(VXL_RAY_DX + a) * batch.stride + i]) * double(hits[i].t);
    }
    return hits;
}

TraceKernels::TraceKernels(const Device& device, const Pyramid& pyramid)
    : device_(device),
      pyramid_(pyramid),
      direct_(features_of(pyramid)),
      dilated_occupancy_(build_dilated_occupancy(device, pyramid)),
      beams_(device, direct_, pyramid, dilated_occupancy_) {
    direct_.shadows = true;
    bouncing_ = direct_;
    bouncing_.paths = true;
}

double TraceKernels::sight(const std::vector<Ray>& rays, std::vector<Hit>* hits) {
    RayBatch batch = batch_of(device_, direct_, pyramid_, rays);
    TraceStage trace(device_, direct_);
    const auto count = uint32_t(rays.size());
    const double seconds = median_seconds([&] {
        beams_.start(batch, count);
        trace.closest(pyramid_, batch, count);
        device_.finish();
    });
    if (hits) *hits = hits_of(batch, count);
    return rate(rays, seconds, batch);
}

double TraceKernels::bounce(const std::vector<Ray>& rays) {
    RayBatch batch = batch_of(device_, bouncing_, pyramid_, rays);
    TraceStage trace(device_, bouncing_);
    const double seconds = median_seconds([&] {
        trace.closest(pyramid_, batch, uint32_t(rays.size()), true);
        device_.finish();
    });
    return rate(rays, seconds, batch);
}

double TraceKernels::shadow(const std::vector<Ray>& rays) {
    RayBatch batch = batch_of(device_, direct_, pyramid_, rays);
    TraceStage trace(device_, direct_);
    const auto count = uint32_t(rays.size());
    std::vector<uint32_t> targets(count);
    std::iota(targets.begin(), targets.end(), 0u);
    ShadowQueue queue;
    queue.rays = batch.rays;
    queue.count = filled<uint32_t>(device_, 1, count);
    queue.traced = filled<uint32_t>(device_, 2, 0);
    queue.targets = Buffer<uint32_t>(device_, "targets", std::span<const uint32_t>(targets));
    queue.sources = filled<uint32_t>(device_, batch.stride, VXL_NO_PRIMITIVE);
    queue.contributions = filled<float>(device_, size_t(batch.stride) * 3, 1.0f);
    batch.radiance.fill(0.0f);
    const Surroundings surroundings{filled<MaterialRecord>(device_, 1, {}),
                                    filled<uint32_t>(device_, 1, 0)};
    LightBeamStage beams(device_, direct_, pyramid_, dilated_occupancy_);
    const BeamGrid grid = beam_grid(light_of(pyramid_), pyramid_.frame.size,
                                    scale_of(dilated_occupancy_.of), count / 4);
    const double seconds = median_seconds([&] {
        if (grid.columns > 0) queue.beams = {grid, beams.send(grid)};
        trace.shadows(pyramid_, surroundings, queue, count, batch);
        device_.finish();
    });
    trace.closest(pyramid_, batch, count);
    return rate(rays, seconds, batch);
}

double TraceKernels::rate(const std::vector<Ray>& rays, double seconds, const RayBatch& batch) {
    hash_ ^= hash_of(batch, rays.size());
    return double(rays.size()) / seconds * 1e-6;
}

}  // namespace voxelume
