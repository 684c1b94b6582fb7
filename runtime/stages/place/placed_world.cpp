// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/placed_world.hpp"

#include <algorithm>
#include <numeric>
#include <utility>

#include "runtime/stages/place/place_painter.hpp"

namespace voxelume {
namespace {

bool is_smooth(const PlacedObject& object) {
    return stores_distances(surface_of(*object.grid));
}

bool has_several_fields(const PlacedObject& object) {
    return !object.grid->parts.empty();
}

/// The rank of each object by priority, by objects' numbers.
std::vector<uint32_t> ranks_of(std::span<const PlacedObject> objects) {
    std::vector<size_t> order(objects.size());
    std::iota(order.begin(), order.end(), size_t{0});
    std::ranges::stable_sort(order, std::ranges::greater(),
                             [&](size_t i) { return objects[i].priority; });
    uint32_t count = 0;
    for (const PlacedObject& object : objects) count = std::max(count, object.object + 1);
    std::vector<uint32_t> ranks(count, 0);
    for (size_t rank = 0; rank < order.size(); ++rank)
        ranks[objects[order[rank]].object] = uint32_t(rank);
    return ranks;
}

/// The part of a lattice with these bricks, as a lattice of its own.
GridFrame part_of(const GridFrame& world, const glm::ivec3& first, const glm::ivec3& last) {
    const glm::ivec3 low = first * kBrickSize;
    return {world.origin + world.voxel_edge * glm::dvec3(low), world.voxel_edge,
            glm::min((last + 1) * kBrickSize, world.size) - low};
}

}  // namespace

WorldPlacer::WorldPlacer(const Device& device)
    : device_(device), near_(std::make_shared<NearLeaves>()), voxels_(device, near_) {}

std::optional<PlacedField> WorldPlacer::place_field(const PlacedObject& object,
                                                    const GridFrame& world) {
    PlacedField field;
    field.object = object.object;
    field.version = ++versions_;
    GridFrame frame = world;
    if (!object.in_world_frame) {
        BrickBox box = bricks_of(object, world);
        box.first = glm::min(box.first, (world.size - 1) / kBrickSize);
        if (box.is_empty()) return {};
        frame = part_of(world, box.first, box.last);
        field.first_brick = box.first;
    }
    Placer placer(device_, near_);
    field.grid = placer.place(std::span(&object, 1), frame);
    painted_ += placer.painted_bricks();
    return field;
}

/// The fields of an object's parts, linked as its grids are.
std::vector<PlacedField> WorldPlacer::place_fields(const PlacedObject& object,
                                                   const GridFrame& world) {
    std::vector<PlacedField> fields;
    const auto add = [&](const BrickGrid& grid, const FieldPlace& place) {
        PlacedObject part = object;
        part.grid = &grid;
        std::optional<PlacedField> field = place_field(part, world);
        if (!field) return;
        field->place = place;
        field->is_first = fields.empty();
        fields.push_back(std::move(*field));
    };
    add(*object.grid, object.grid->place);
    for (const GridPart& part : object.grid->parts) add(*part.grid, part.place);
    return fields;
}

void WorldPlacer::place_voxels(std::span<const PlacedObject> objects, const GridFrame& world) {
    world_.voxels = {};  // frees lists that would otherwise coexist with the new ones
    world_.voxels = voxels_.place(objects, world);
    painted_ += voxels_.painted_bricks();
    const std::vector<uint32_t>* changed = voxels_.changed_bricks();
    changed_.reset();
    if (changed) changed_ = *changed;
}

const PlacedWorld& WorldPlacer::place(std::span<const PlacedObject> objects,
                                      const GridFrame& world) {
    painted_ = 0;
    near_->begin_list();
    const bool had_fields = !world_.fields.empty();
    world_.fields.clear();
    world_.ranks = ranks_of(objects);
    // A single remaining field stays apart, since others may come back.
    const bool apart = (objects.size() > 1 || (had_fields && frame_ == world) ||
                        std::ranges::any_of(objects, has_several_fields)) &&
                       std::ranges::any_of(objects, is_smooth);
    if (!apart || frame_ != world) fields_.clear();
    frame_ = world;
    if (!apart) {
        place_voxels(objects, world);
        if (had_fields) changed_.reset();
        return world_;
    }
    std::vector<PlacedObject> others;
    std::ranges::copy_if(objects, std::back_inserter(others), std::not_fn(is_smooth));
    place_voxels(others, world);
    bool is_same = had_fields && changed_ && changed_->empty();
    std::map<uint32_t, Kept> before = std::exchange(fields_, {});
    for (const PlacedObject& object : objects) {
        if (!is_smooth(object)) continue;
        const auto found = before.find(object.object);
        if (found != before.end() && found->second.object == object) {
            fields_.insert(before.extract(found));
            continue;
        }
        is_same = false;
        fields_.emplace(object.object, Kept{object, place_fields(object, world)});
    }
    is_same &= before.empty();
    for (const auto& [number, kept] : fields_)
        world_.fields.insert(world_.fields.end(), kept.fields.begin(), kept.fields.end());
    std::ranges::stable_sort(world_.fields, {},
                             [&](const PlacedField& field) { return world_.ranks[field.object]; });
    changed_.reset();
    if (is_same) changed_.emplace();
    return world_;
}

PlacedWorld place_world(const Device& device, std::span<const PlacedObject> objects,
                        const GridFrame& world) {
    return WorldPlacer(device).place(objects, world);
}

}  // namespace voxelume
