// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/trace/sight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <limits>

#include "runtime/opencl/float4.hpp"

namespace voxelume {
namespace {

/// The distance along Z_E from the observer to the world's nearest corner, in metres; 0 if that
/// corner is not in front.
double depth_of_world(const Observer& observer, const GridFrame& world) {
    double minimum = std::numeric_limits<double>::infinity();
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 step(corner & 1, corner >> 1 & 1, corner >> 2);
        const glm::dvec3 point = world.origin + world.voxel_edge * glm::dvec3(world.size) * step;
        minimum =
            std::min(minimum, glm::dot(point - observer.position, observer.world_from_observer[2]));
    }
    return std::max(minimum, 0.0);
}

}  // namespace

Camera camera_of(const Scene& scene, const GridFrame& world) {
    const Observer& observer = scene.observer;
    const glm::dmat3& axes = observer.world_from_observer;
    // Rays of a pyramid or box far from the world start at the world's depth, since floats would
    // lose precision on the way there.
    const DisplayShapeRow& shape = shape_row(observer.display);
    const double lead = shape.depth_is_along_z ? depth_of_world(observer, world) : 0.0;
    const glm::dvec3 origin =
        (observer.position + axes[2] * lead - world.origin) / world.voxel_edge;
    const glm::dvec2 half = shape.half_extent(observer.display);
    Camera camera{};
    camera.origin = to_float4(origin);
    camera.origin_low =
        to_float4(origin - glm::dvec3(camera.origin.x, camera.origin.y, camera.origin.z));
    camera.axis_x = to_float4(axes[0] / world.voxel_edge);
    camera.axis_y = to_float4(axes[1] / world.voxel_edge);
    camera.axis_z = to_float4(axes[2] / world.voxel_edge);
    camera.half_x = float(half.x);
    camera.half_y = float(half.y);
    camera.near_plane = float(observer.display.near - lead);
    camera.far_plane = float(observer.display.far - lead);
    camera.lead = float(lead);
    camera.width = scene.render.size.x;
    camera.height = scene.render.size.y;
    const glm::ivec2 frame = frame_size(scene.render);
    camera.first_column = scene.render.crop.first.x;
    camera.first_row = scene.render.crop.first.y;
    camera.frame_width = frame.x;
    camera.frame_height = frame.y;
    camera.samples = scene.render.samples;
    camera.first_sample = scene.render.first_sample;
    camera.shape = shape.kernel_number;
    if (observer.aperture > 0) {
        camera.lens_radius = float(observer.aperture / 2);
        camera.lens_slope = float(observer.aperture / 2 / observer.focus);
        camera.blades = observer.blades;
    }
    camera.sample_weight = 1.0f / float(scene.render.samples);
    camera.is_last = 1;
    return camera;
}

double voxels_a_pixel(const Scene& scene, const Camera& camera, const GridFrame& world) {
    const Observer& observer = scene.observer;
    const glm::dvec2 pixel =
        2.0 * half_extent(observer.display) / glm::dvec2(camera.frame_width, camera.frame_height);
    const glm::dvec3 middle = world.origin + 0.5 * world.voxel_edge * glm::dvec3(world.size);
    const double metres = shape_row(observer.display).projection == SightProjection::parallel
                              ? 1.0
                              : glm::distance(middle, observer.position);
    const glm::dvec3& edge = world.voxel_edge;
    return std::max(pixel.x, pixel.y) * metres / std::min({edge.x, edge.y, edge.z});
}

std::vector<float> sample_offsets(int samples, int first, const ReconstructionFilter& filter) {
    constexpr double kPlastic = 1.32471795724474602596;
    std::vector<float> offsets;
    for (int i = first; i < first + samples; ++i) {
        for (const double step : {1 / kPlastic, 1 / (kPlastic * kPlastic)}) {
            const double x = 0.5 + i * step;
            const double share = x - std::floor(x);
            offsets.push_back(
                float(filter.is_pixel() ? share : 0.5 + filter_offset(filter, share)));
        }
    }
    return offsets;
}

std::vector<float> filter_positions(const ReconstructionFilter& filter) {
    std::vector<float> positions(VXL_FILTER_STEPS + 1);
    // The filter is even, and the middle of the pixel is the middle of its weight.
    for (size_t i = 0; i <= VXL_FILTER_STEPS / 2; ++i) {
        const double share = double(i) / VXL_FILTER_STEPS;
        const double offset = filter.is_pixel() ? share - 0.5 : filter_offset(filter, share);
        positions[i] = float(0.5 + offset);
        positions[VXL_FILTER_STEPS - i] = float(0.5 - offset);
    }
    return positions;
}

uint32_t tile_count(int width, int height) {
    return uint32_t((width + 3) / 4) * uint32_t((height + 3) / 4);
}

SightStage::SightStage(const Device& device, const Features& features, const Camera& camera,
                       const ReconstructionFilter& filter)
    : camera_(camera),
      offsets_(device, "sample offsets",
               std::span<const float>(
                   features.scattered_sight
                       ? filter_positions(filter)
                       : sample_offsets(camera.samples, camera.first_sample, filter))),
      program_(device, "sight.cl", features.defines(device)),
      cast_(program_.kernel("cast_sight")) {}

void SightStage::choose(const Device& device, std::span<const uint32_t> pixels) {
    pixels_.emplace(device, "chosen pixels", pixels);
    cast_ = program_.kernel("cast_listed");
}

uint32_t SightStage::cast(const PyramidShape& world, uint32_t first_tile, uint32_t tiles,
                          RayBatch& batch) {
    const uint32_t count = tiles * 16u * uint32_t(camera_.samples);
    if (pixels_)
        cast_.launch_packets(count, camera_, world, offsets_, *pixels_, first_tile, count,
                             batch.stride, batch.rays);
    else
        cast_.launch_packets(count, camera_, world, offsets_, first_tile, count, batch.stride,
                             batch.rays);
    return count;
}

}  // namespace voxelume
