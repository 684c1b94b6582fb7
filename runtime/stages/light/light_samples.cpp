// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/light_samples.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/float4.hpp"
#include "runtime/scene/parts/light.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/stages/light/emissive_pieces.hpp"

namespace voxelume {
namespace {

LightRecord area_sample_record(const glm::dvec3& position, const glm::dvec3& normal,
                               const glm::dvec3& intensity, double area) {
    LightRecord record{};
    record.position = to_float4(position);
    record.direction = to_float4(normal);
    record.intensity = to_float4(intensity);
    record.kind = VXL_LIGHT_AREA_SAMPLE;
    record.spread = float(area / std::numbers::pi);
    return record;
}

/// The height of a light sample above its surface, in voxels' longest edges.
///
/// Rays are snapped: the origin by 1/4 of plane_bound, the direction by 2^-23 of a length of up to
/// 2^22 plane_bound, in each coordinate. So they end within 1.25 sqrt(3) plane_bound of the light
/// sample. The sample is 1/32 voxel above the plane that touches the surface there, so nothing
/// convex reaches them.
double light_sample_offset(const Pyramid& world) {
    return 1.0 / 32 + 3 * double(shape_of(world).plane_bound);
}

/// The pieces whose light samples lie in the world.
std::vector<EmissivePiece> pieces_in_world(const std::vector<EmissivePiece>& pieces,
                                           double origin_offset, const GridFrame& world) {
    const glm::dvec3 size = glm::dvec3(world.size) * world.voxel_edge;
    std::vector<EmissivePiece> inside;
    for (const EmissivePiece& piece : pieces) {
        const glm::dvec3 p = piece.position + piece.normal * origin_offset;
        if (p == glm::clamp(p, glm::dvec3(0), size)) inside.push_back(piece);
    }
    return inside;
}

double area_of(const std::vector<EmissivePiece>& pieces) {
    double sum = 0;
    for (const EmissivePiece& piece : pieces) sum += piece.area;
    return sum;
}

}  // namespace

int default_light_samples(double area, const glm::dvec3& voxel_edge) {
    const double side = 4 * std::max({voxel_edge.x, voxel_edge.y, voxel_edge.z});
    return int(std::clamp(std::round(area / (side * side)), 16.0, 128.0));
}

std::vector<LightRecord> area_light_samples(const Light& light, const GridFrame& world) {
    const LightArea& shape = *type_of(light).area;
    const double area = shape.area(light);
    const glm::dvec3 axis_y = glm::cross(light.direction, light.axis_x);
    std::vector<LightRecord> records;
    for (const glm::dvec2& p : shape.points(light)) {
        const glm::dvec3 position = light.position + p.x * light.axis_x + p.y * axis_y;
        records.push_back(area_sample_record(
            (position - world.origin) / world.voxel_edge, light.direction,
            glm::dvec3(light.intensity) / double(light.light_samples), area / light.light_samples));
    }
    return records;
}

LightAreaRecord light_area_record(const Light& light, const GridFrame& world) {
    const LightArea& shape = *type_of(light).area;
    const glm::dvec2 half = shape.half_axes(light);
    LightAreaRecord record{};
    record.axis_x = to_float4(light.axis_x * half.x / world.voxel_edge);
    record.axis_y =
        to_float4(glm::cross(light.direction, light.axis_x) * half.y / world.voxel_edge);
    record.axis_x.w = shape.is_round ? 1.0f : 0.0f;
    record.axis_y.w = float(half.x * half.y * (shape.is_round ? std::numbers::pi : 4.0));
    return record;
}

std::vector<LightRecord> emissive_light_samples(const Device& device, const Features& features,
                                                const Scene& scene, const Pyramid& world) {
    std::vector<uint32_t> emissive_objects;
    emissive_objects.reserve(scene.objects.size());
    for (const Object& object : scene.objects)
        emissive_objects.push_back(is_emissive(scene, object));
    const glm::dvec3& edge = world.frame.voxel_edge;
    const double longest = std::max({edge.x, edge.y, edge.z});
    std::vector<LightRecord> records;
    for (const auto& [object, all] :
         emissive_pieces(device, features, scene, world, emissive_objects)) {
        const bool is_instance = is_instanced(scene, scene.objects[object]);
        const double origin_offset =
            longest * (light_sample_offset(world) +
                       (is_instance ? double(world.instances.origin_offset) : 0.0));
        std::vector<EmissivePiece> pieces = pieces_in_world(all, origin_offset, world.frame);
        const int count = scene.objects[object].light_samples.value_or(
            default_light_samples(area_of(pieces), edge));
        for (const LightSample& light_sample : choose_light_samples(pieces, count))
            records.push_back(area_sample_record(
                (light_sample.position + light_sample.normal * origin_offset) / edge,
                light_sample.normal, light_sample.power / std::numbers::pi, light_sample.area));
    }
    return records;
}

}  // namespace voxelume
