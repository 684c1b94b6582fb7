#include "runtime/stages/light/light_samples.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <numbers>

#include "runtime/opencl/float4.hpp"
#include "runtime/stages/light/emissive_pieces.hpp"
#include "runtime/stages/trace/trace.hpp"

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

/// The middles of `count` equal parts of a rectangle, halved across its longer side.
void divide(glm::dvec2 middle, glm::dvec2 size, int count, std::vector<glm::dvec2>& middles) {
    if (count == 1) return middles.push_back(middle);
    const int axis = size.y > size.x ? 1 : 0;
    const int low_count = count / 2;
    const double low = size[axis] * low_count / count, first = middle[axis] - size[axis] / 2;
    const double high = size[axis] - low;
    size[axis] = low;
    middle[axis] = first + low / 2;
    divide(middle, size, low_count, middles);
    size[axis] = high;
    middle[axis] = first + low + high / 2;
    divide(middle, size, count - low_count, middles);
}

/// Vogel's spiral: points that share a disk evenly, each an angle of pi (3 - sqrt 5) on.
std::vector<glm::dvec2> points_of_disk(double radius, int count) {
    const double step = std::numbers::pi * (3 - std::sqrt(5.0));
    if (count == 1) return {glm::dvec2(0)};
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const double r = radius * std::sqrt((i + 0.5) / count);
        points.emplace_back(r * std::cos(i * step), r * std::sin(i * step));
    }
    return points;
}

/// How far above its surface a light sample stands, in voxels' longest edges.
///
/// Rays are snapped: the origin by 1/4 of plane_bound, the direction by 2^-23 of a way of up to
/// 2^22 plane_bound, in each coordinate. So they end within 1.25 sqrt(3) plane_bound of the spot,
/// 1/32 voxel above the plane that touches the surface there, and nothing convex reaches them.
double light_sample_offset(const Pyramid& world) {
    return 1.0 / 32 + 3 * double(shape_of(world).plane_bound);
}

/// The pieces that are in sight of the world.
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

bool is_emissive(const Scene& scene, const Object& object) {
    return object.visible && object.light_samples.value_or(1) > 0 && has_emission(scene, object);
}

int default_light_samples(double area, const glm::dvec3& voxel_edge) {
    const double side = 4 * std::max({voxel_edge.x, voxel_edge.y, voxel_edge.z});
    return int(std::clamp(std::round(area / (side * side)), 16.0, 128.0));
}

std::vector<LightRecord> area_light_samples(const Light& light, const GridFrame& world) {
    const bool is_disk = light.kind == LightKind::disk;
    const double area =
        is_disk ? std::numbers::pi * light.radius * light.radius : light.size.x * light.size.y;
    std::vector<glm::dvec2> points;
    if (is_disk)
        points = points_of_disk(light.radius, light.light_samples);
    else
        divide({0, 0}, light.size, light.light_samples, points);
    const glm::dvec3 axis_y = glm::cross(light.direction, light.axis_x);
    std::vector<LightRecord> records;
    for (const glm::dvec2& p : points) {
        const glm::dvec3 position = light.position + p.x * light.axis_x + p.y * axis_y;
        records.push_back(area_sample_record(
            (position - world.origin) / world.voxel_edge, light.direction,
            glm::dvec3(light.intensity) / double(light.light_samples), area / light.light_samples));
    }
    return records;
}

std::vector<LightRecord> emissive_light_samples(const Device& device, const Features& features,
                                                const Scene& scene, const Pyramid& world) {
    std::vector<uint32_t> emissive_objects;
    for (const Object& object : scene.objects)
        emissive_objects.push_back(is_emissive(scene, object));
    const glm::dvec3& edge = world.frame.voxel_edge;
    const double origin_offset = light_sample_offset(world) * std::max({edge.x, edge.y, edge.z});
    std::vector<LightRecord> records;
    for (const auto& [object, all] :
         emissive_pieces(device, features, scene, world, emissive_objects)) {
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
