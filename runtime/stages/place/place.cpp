// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/place/place.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>
#include <optional>
#include <stdexcept>

#include "kernels/shared/voxel.h"
#include "runtime/base/error.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/place/place_exact.hpp"
#include "runtime/stages/place/place_painter.hpp"
#include "runtime/stages/place/placement_map.hpp"
#include "runtime/stages/place/world_bricks.hpp"

namespace voxelume {
namespace {

/// Refuses a field whose band would end inside of the world's voxels.
void check_band(const PlacedObject& object, const GridFrame& world) {
    if (object.in_world_frame || !stores_distances(surface_of(*object.grid))) return;
    const double ratio =
        voxels_per_world_voxel(object.grid->frame, world, object.world_from_object);
    if (!std::isfinite(ratio) || ratio <= kFinestField) return;  // others find a singular map
    throw Error(ErrorKind::scene,
                "object {}: the world's voxels are {:.3g} times as large as those of its distance "
                "field, and at most {} times are possible: voxelize it more coarsely, or place it "
                "as an instance",
                object.object, ratio, kFinestField);
}

void check_object(const PlacedObject& object, const GridFrame& world) {
    if (object.in_world_frame && object.grid->frame != world)
        throw Error(ErrorKind::scene,
                    "object {}: its voxels have another frame than the world that they were made "
                    "for: voxelize it in the world's frame",
                    object.object);
    if (!object.in_world_frame && lists_primitives(surface_of(*object.grid)))
        throw Error(ErrorKind::scene,
                    "object {}: an exact surface can't be resampled: voxelize it in the world's "
                    "frame",
                    object.object);
    check_band(object, world);
    if (object.object > VXL_OBJECT_MASK)
        throw Error(ErrorKind::limit, "object {}: a world holds at most {} objects", object.object,
                    VXL_OBJECT_MASK + 1);
}

/// The objects, sorted so that the loser of every overlap comes before its winner.
std::vector<const PlacedObject*> painting_order(std::span<const PlacedObject> objects) {
    std::vector<const PlacedObject*> order;
    for (size_t i = objects.size(); i-- > 0;) order.push_back(&objects[i]);
    std::ranges::stable_sort(order, {}, &PlacedObject::priority);
    return order;
}

/// True if the world can share its only object's buffers: they are in its frame, and all their
/// voxels get one value of packed attributes.
bool is_only_object(std::span<const PlacedObject> objects, const WorldParts& parts) {
    return objects.size() == 1 && objects[0].in_world_frame && !parts.has_attributes() &&
           !objects[0].keeps_inside && !lists_primitives(surface_of(*objects[0].grid));
}

}  // namespace

/// The objects placed last, and their world.
class Placer::State {
  public:
    State(const Device& device, const GridFrame& frame, NearLeaves& near)
        : device_(device), near_(near) {
        world_.frame = frame;
    }

    bool continues_with(const GridFrame& frame) const { return bricks_ && frame == world_.frame; }

    /// Uses the object's own buffers as the world. The next call then begins with an empty world.
    void share(const PlacedObject& object, const WorldParts& parts) {
        world_ = *object.grid;
        world_.attributes = {};
        world_.attribute = *parts.attributes.begin();
    }

    void place(std::span<const PlacedObject> objects, const WorldParts& parts) {
        follow(parts);
        std::map<uint32_t, Painter> left = std::exchange(painters_, {});
        std::vector<Painter*> changed;
        take_painters(objects, left, changed);
        for (auto& [number, painter] : left) changed.push_back(&painter);
        if (bricks_ && changed.empty()) {
            changed_.emplace();
            painted_ = 0;
            return;
        }
        paint(objects, store_bricks(changed));
        join_exact_surfaces(device_, objects, world_);
    }

    const BrickGrid& world() const { return world_; }
    uint32_t painted() const { return painted_; }
    const std::vector<uint32_t>* changed() const { return changed_ ? &*changed_ : nullptr; }

  private:
    /// Makes the world store exactly the parts that the objects now need. A new part has one value
    /// in every brick, so no brick is painted for it.
    void follow(const WorldParts& parts) {
        const bool is_stored_otherwise = bricks_ && !parts.is_stored_like(parts_);
        parts_ = parts;
        if (!is_stored_otherwise) return;
        bricks_->store_like(parts);
        for (auto& [number, painter] : painters_) painter.follow(device_, parts);
    }

    /// Makes a painter for each object that changed, listed in `changed` too, and takes the others
    /// from `left`.
    void take_painters(std::span<const PlacedObject> objects, std::map<uint32_t, Painter>& left,
                       std::vector<Painter*>& changed) {
        for (const PlacedObject& object : objects) {
            const auto before = left.find(object.object);
            if (before != left.end() && before->second.object() == object) {
                painters_.insert(left.extract(before));
                continue;
            }
            const auto added =
                painters_.try_emplace(object.object, device_, object, world_.frame, parts_, near_);
            changed.push_back(&added.first->second);
        }
    }

    /// Calls `visit` with the index of each brick of a box.
    template <class Visit>
    void for_each_brick(const BrickBox& box, Visit&& visit) const {
        const glm::ivec3 table = world_.frame.bricks();
        for (int z = box.first.z; z <= box.last.z; ++z)
            for (int y = box.first.y; y <= box.last.y; ++y)
                for (int x = box.first.x; x <= box.last.x; ++x)
                    visit(uint32_t(x) +
                          uint32_t(table.x) * (uint32_t(y) + uint32_t(table.y) * uint32_t(z)));
    }

    /// The states that objects give to the world's bricks: to all bricks if `asked` is empty, else
    /// only to those for which it is true.
    template <class Painters>
    std::vector<uint8_t> states(Painters&& painters, const std::vector<bool>& asked) {
        const glm::ivec3 table = world_.frame.bricks();
        const auto count = uint32_t(table.x) * uint32_t(table.y) * uint32_t(table.z);
        Buffer<uint8_t> states(device_, "brick states", count);
        states.fill(0);
        for (Painter* painter : painters) {
            std::vector<uint32_t> listed;
            for_each_brick(painter->bricks(), [&](uint32_t brick) {
                if (asked.empty() || asked[brick]) listed.push_back(brick);
            });
            if (listed.size() == count)
                painter->classify(world_.frame, count, {}, states);
            else if (!listed.empty())
                painter->classify(world_.frame, uint32_t(listed.size()),
                                  Buffer<uint32_t>(device_, "listed bricks", listed), states);
        }
        return states.read();
    }

    std::vector<Painter*> all_painters() {
        std::vector<Painter*> all;
        all.reserve(painters_.size());
        for (auto& [number, painter] : painters_) all.push_back(&painter);
        return all;
    }

    /// Stores the bricks that the objects need. Returns the bricks to paint: those that a changed
    /// painter covers now or covered before.
    std::vector<uint32_t> store_bricks(const std::vector<Painter*>& changed) {
        if (!bricks_) {
            bricks_.emplace(device_, parts_, world_);
            changed_.reset();
            const std::vector<uint8_t> found = states(all_painters(), {});
            std::vector<uint32_t> bricks(found.size());
            std::iota(bricks.begin(), bricks.end(), 0u);
            return bricks_->store(bricks, found);
        }
        changed_.emplace();
        if (changed.empty()) return {};
        const std::vector<uint8_t> reached = states(changed, {});
        std::vector<bool> asked(reached.size());
        for (uint32_t brick = 0; brick < reached.size(); ++brick) {
            if (reached[brick] == 0) continue;
            asked[brick] = true;
            changed_->push_back(brick);
        }
        return bricks_->store(*changed_, states(all_painters(), asked));
    }

    /// The bricks of a box that are among the `painted` bricks of the world.
    PaintedBricks painted_bricks(const std::vector<bool>& painted, const BrickBox& box) {
        std::vector<uint32_t> slots;
        for_each_brick(box, [&](uint32_t brick) {
            if (painted[brick]) slots.push_back(bricks_->slot(brick));
        });
        return {uint32_t(slots.size()), Buffer<uint32_t>(device_, "painted bricks", slots)};
    }

    void paint(std::span<const PlacedObject> objects, const std::vector<uint32_t>& bricks) {
        painted_ = uint32_t(bricks.size());
        world_.transparent = parts_.transparent;
        world_.cubes = parts_.cubes;
        world_.attribute = parts_.attributes.size() == 1 ? *parts_.attributes.begin() : 0;
        if (bricks.empty()) return;
        bricks_->clear(bricks);
        const glm::ivec3 table = world_.frame.bricks();
        std::vector<bool> painting(brick_slots(world_.frame));
        for (const uint32_t brick : bricks) painting[brick] = true;
        Painter* smooth = nullptr;
        for (const PlacedObject* object : painting_order(objects)) {
            Painter& painter = painters_.at(object->object);
            painter.paint(painted_bricks(painting, painter.bricks()), world_);
            if (stores_distances(painter.surface())) smooth = &painter;
        }
        if (smooth)
            smooth->close_distances(painted_bricks(painting, {glm::ivec3(0), table - 1}), world_);
    }

    Device device_;
    NearLeaves& near_;
    BrickGrid world_;
    WorldParts parts_;
    std::optional<WorldBricks> bricks_;     ///< empty before the first call of `place`
    std::map<uint32_t, Painter> painters_;  ///< by the numbers of their objects
    std::optional<std::vector<uint32_t>> changed_;
    uint32_t painted_ = 0;
};

Placer::Placer(const Device& device, std::shared_ptr<NearLeaves> near)
    : device_(device),
      owns_near_(!near),
      near_(near ? std::move(near) : std::make_shared<NearLeaves>()) {}
Placer::~Placer() = default;

const BrickGrid& Placer::place(std::span<const PlacedObject> objects, const GridFrame& world) {
    for (const PlacedObject& object : objects) check_object(object, world);
    if (owns_near_) near_->begin_list();
    const WorldParts parts = parts_of(objects);
    if (parts.smooth && objects.size() > 1)
        throw std::logic_error(
            "fields of several objects don't merge: place_world keeps them apart");
    std::unique_ptr<State> state = std::move(state_);
    if (is_only_object(objects, parts)) {
        state = std::make_unique<State>(device_, world, *near_);
        state->share(objects[0], parts);
    } else {
        if (!state || !state->continues_with(world))
            state = std::make_unique<State>(device_, world, *near_);
        state->place(objects, parts);
    }
    state_ = std::move(state);
    return state_->world();
}

uint32_t Placer::painted_bricks() const {
    return state_ ? state_->painted() : 0;
}

const std::vector<uint32_t>* Placer::changed_bricks() const {
    return state_ ? state_->changed() : nullptr;
}

BrickGrid place(const Device& device, std::span<const PlacedObject> objects,
                const GridFrame& world) {
    return Placer(device).place(objects, world);
}

}  // namespace voxelume
