// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light.hpp"

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/float4.hpp"
#include "runtime/scene/parts/light.hpp"

namespace voxelume {
LightRecord light_record(const Light& light, const GridFrame& world) {
    LightRecord record{};
    const LightType& type = type_of(light);
    record.position =
        to_float4(type.has_position ? (light.position - world.origin) / world.voxel_edge
                                    : -light.direction / world.voxel_edge);
    record.direction = to_float4(light.direction);
    record.intensity = to_float4(glm::dvec3(light.intensity));
    record.intensity.w = light.is_dark ? 1 : 0;
    record.inner_cosine = float(std::cos(light.inner_half_angle));
    record.outer_cosine = float(std::cos(light.outer_half_angle));
    record.kind = type.shading;
    return record;
}

double radius_of(const LightAreaRecord& area, const GridFrame& world) {
    const auto length = [&](const float4& axis) {
        return glm::length(glm::dvec3(axis.x, axis.y, axis.z) * world.voxel_edge);
    };
    const double x = length(area.axis_x), y = length(area.axis_y);
    return area.axis_x.w != 0 ? std::max(x, y) : std::hypot(x, y);
}

bool may_light(const LightRecord& light, const GridFrame& world) {
    // The kernel has directions and cosines as floats: 2^-24 of a cosine near 1 is 3.5e-4 radians.
    constexpr double kRounding = 1e-6, kAngleRounding = 1e-3;
    const glm::dvec3 at(light.position.x, light.position.y, light.position.z);
    const glm::dvec3 along(light.direction.x, light.direction.y, light.direction.z);
    const glm::dvec3 extent = world.voxel_edge * glm::dvec3(world.size);
    const glm::dvec3 to_middle = 0.5 * extent - world.voxel_edge * at;
    const double distance = glm::length(to_middle), radius = 0.5 * glm::length(extent);
    const double rounding = kRounding * (distance + radius);
    if (light.kind == VXL_LIGHT_AREA_SAMPLE)
        return glm::dot(to_middle, along) + radius + rounding > 0;
    if (light.kind != VXL_LIGHT_SPOT || distance <= radius + rounding) return true;
    // The ball around the world subtends an angle of arcsin(radius / distance) around its middle.
    const double aside = std::acos(std::clamp(glm::dot(to_middle, along) / distance, -1.0, 1.0));
    const double half_angle = std::acos(std::clamp(double(light.outer_cosine), -1.0, 1.0));
    return aside - std::asin(radius / distance) <= half_angle + kAngleRounding;
}

LightStage::LightStage(const Device& device, const Features& features,
                       const Buffer<MaterialRecord>& materials)
    : materials_(materials),
      program_(device, "light.cl", features.defines(device)),
      add_(program_.kernel("add_light")) {}

void LightStage::add(const Pyramid& pyramid, const LightRecord& light, RayBatch& batch,
                     uint32_t count, ShadowQueue& queue) {
    if (!queue.count.empty()) queue.count.fill(0);
    add_.launch_packets(count, pyramid, light, materials_, queue, batch, count);
}

}  // namespace voxelume
