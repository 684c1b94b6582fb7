// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/instance/instances.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/matrix.hpp>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/stages/instance/instance_tree.hpp"
#include "runtime/stages/place/placement_map.hpp"

namespace voxelume {
namespace {

constexpr double kWholeBound = 1e-9;  // voxels; accuracy of decimal placements by whole voxels

/// The affine map between voxels, object voxels = linear * world voxels + offset.
struct VoxelMap {
    glm::dmat3 linear{1};
    glm::dvec3 offset{0};
};

VoxelMap object_from_world(const GridFrame& object, const GridFrame& world,
                           const glm::dmat4& world_from_object) {
    const glm::dmat3 inverse = glm::inverse(glm::dmat3(world_from_object));
    VoxelMap map;
    for (int column = 0; column < 3; ++column)
        map.linear[column] = inverse[column] * world.voxel_edge[column] / object.voxel_edge;
    map.offset = (inverse * (world.origin - glm::dvec3(world_from_object[3])) - object.origin) /
                 object.voxel_edge;
    return map;
}

/// True if the map is surely invertible: the norms bound its stretch in every direction.
bool is_well_conditioned(const glm::dmat4& map) {
    constexpr double kSafeCondition = 1e4;
    const auto norm = [](const glm::dmat3& m) {
        return std::sqrt(glm::dot(m[0], m[0]) + glm::dot(m[1], m[1]) + glm::dot(m[2], m[2]));
    };
    const glm::dmat3 linear(map);
    return norm(linear) * norm(glm::inverse(linear)) < kSafeCondition &&
           glm::length(glm::dvec3(map[3])) < 1e9;
}

bool is_whole(double value) {
    return std::abs(value - std::round(value)) < kWholeBound;
}

/// True if the map only shifts by whole voxels, turns by quarters and mirrors, and if the object's
/// voxels are so near that the world's fixed point can hold every distance to them.
bool is_aligned(const VoxelMap& map, const InstanceModel& model, const PyramidShape& world) {
    const double extent = std::ldexp(1.0, 24) / double(world.fixed_point);
    const glm::dvec3 size(world.size_x, world.size_y, world.size_z);
    for (int row = 0; row < 3; ++row) {
        double length = 0, low = map.offset[row], high = map.offset[row];
        for (int column = 0; column < 3; ++column) {
            const double value = map.linear[column][row];
            if (!is_whole(value) || std::abs(value) > 1.5) return false;
            length += std::abs(value);
            (value < 0 ? low : high) += std::round(value) * size[column];
        }
        if (std::round(length) != 1 || !is_whole(map.offset[row])) return false;
        if (std::max(-low, high) > extent || double(model.frame.size[row]) - low > extent)
            return false;
    }
    return true;
}

/// The largest sum of a row's absolute values.
double row_sum(const glm::dmat3& m) {
    double largest = 0;
    for (int row = 0; row < 3; ++row)
        largest =
            std::max(largest, std::abs(m[0][row]) + std::abs(m[1][row]) + std::abs(m[2][row]));
    return largest;
}

void copy(const glm::dvec3& from, float (&to)[3]) {
    for (int axis = 0; axis < 3; ++axis) to[axis] = float(from[axis]);
}

/// The record of one instance for kernels, and its box in the world.
struct Placed {
    InstanceRecord record{};
    InstanceBox box;
    double origin_offset = 0;
};

Placed place_instance(const Instance& instance, const InstanceModel& model,
                      const GridFrame& world_frame, const PyramidShape& world,
                      const glm::dmat4& world_from_object) {
    if (!is_well_conditioned(world_from_object))  // the call measures the map exactly, and throws
                                                  // an error if it is singular
        placement_map(model.frame, world_frame, world_from_object, Reach::none, instance.object);
    VoxelMap map = object_from_world(model.frame, world_frame, world_from_object);
    Placed placed;
    InstanceRecord& record = placed.record;
    Pyramid grid;
    grid.frame = model.frame;
    const PyramidShape shape = shape_of(grid);
    glm::dvec3 low(model.low), high(model.high);
    record.aligned = is_aligned(map, model, world);
    record.plane_bound = record.aligned ? world.plane_bound : shape.plane_bound;
    record.fixed_point = record.aligned ? world.fixed_point : shape.fixed_point;
    if (record.aligned) {
        for (int column = 0; column < 3; ++column)
            map.linear[column] = glm::round(map.linear[column]);
        map.offset = glm::round(map.offset);
        low -= 1.0, high += 1.0;  // a ray that touches a voxel never misses the box
    }
    const glm::dmat3 world_from_voxels = glm::inverse(map.linear);
    const glm::dvec3 middle = world_from_voxels * ((low + high) * 0.5 - map.offset);
    const glm::dvec3 center = glm::round(middle);
    placed.box = {middle, middle};
    double radius = 0;
    for (int corner = 0; corner < 8; ++corner) {
        const glm::dvec3 at(corner & 1 ? high.x : low.x, corner & 2 ? high.y : low.y,
                            corner & 4 ? high.z : low.z);
        const glm::dvec3 p = world_from_voxels * (at - map.offset);
        placed.box = {glm::min(placed.box.low, p), glm::max(placed.box.high, p)};
        radius = std::max(radius, glm::distance(p, center));
    }
    for (int row = 0; row < 3; ++row)
        for (int column = 0; column < 3; ++column)
            record.object_from_world[3 * row + column] = float(map.linear[column][row]);
    copy(center, record.center);
    copy(map.linear * center + map.offset, record.image);
    copy(low, record.low);
    copy(high, record.high);
    record.near_squared = float(4 * radius * radius);
    for (int axis = 0; axis < 3; ++axis) record.size[axis] = model.frame.size[axis];
    record.sectors_x = shape.sectors_x;
    record.sectors_y = shape.sectors_y;
    record.first_sector = model.first_sector;
    record.object = instance.object;
    record.first_material = instance.first_material;
    record.material_count = instance.material_count;

    // A point of the surface is accurate within plane_bound along each axis of the world; a
    // transformed point is accurate within twice the plane_bound of the object.
    const glm::dvec3& e = world_frame.voxel_edge;
    const double uneven = std::max({e.x, e.y, e.z}) / std::min({e.x, e.y, e.z});
    placed.origin_offset = std::sqrt(3.0) * uneven *
                           (world.plane_bound + 2 * row_sum(world_from_voxels) * shape.plane_bound);
    record.bounds_rounding = float(placed.origin_offset);
    return placed;
}

}  // namespace

void set_instances(const Device& device, std::span<const Instance> list,
                   std::span<const uint32_t> materials, Pyramid& pyramid) {
    InstanceSet& set = pyramid.instances;
    set.list.clear();
    for (const Instance& instance : list) {
        const InstanceModel& model = set.models[instance.model];
        if (model.low.x < model.high.x) set.list.push_back(instance);
    }
    set.materials = Buffer<uint32_t>(device, "instance materials", materials);
}

void place_instances(const Device& device, std::span<const glm::dmat4> world_from_object,
                     Pyramid& pyramid) {
    InstanceSet& set = pyramid.instances;
    if (set.empty()) return;
    const PyramidShape world = shape_of(pyramid);
    std::vector<InstanceRecord> records;
    std::vector<InstanceBox> boxes;
    records.reserve(set.list.size());
    boxes.reserve(set.list.size());
    double origin_offset = 0;
    VoxelBox all{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const Instance& instance : set.list) {
        const Placed placed = place_instance(instance, set.models[instance.model], pyramid.frame,
                                             world, world_from_object[instance.object]);
        records.push_back(placed.record);
        boxes.push_back(placed.box);
        all = {glm::min(all.low, placed.box.low), glm::max(all.high, placed.box.high)};
        origin_offset = std::max(origin_offset, placed.origin_offset);
    }
    // Slab tests place planes with an error of at most plane_bound, for transformed rays, too.
    const std::vector<InstanceNode> nodes =
        build_instance_tree(boxes, 4 * double(world.plane_bound) + origin_offset);
    set.origin_offset = float(origin_offset);
    set.box = all;
    set.records = Buffer<InstanceRecord>(device, "instances", records);
    set.nodes = Buffer<InstanceNode>(device, "instance tree", nodes);
}

}  // namespace voxelume
