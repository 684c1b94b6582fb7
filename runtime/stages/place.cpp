#include "runtime/stages/place.hpp"

#include <algorithm>
#include <map>
#include <optional>

#include "kernels/shared/voxel.h"
#include "runtime/error.hpp"
#include "runtime/stages/place_exact.hpp"
#include "runtime/stages/place_painter.hpp"
#include "runtime/stages/world_bricks.hpp"

namespace voxelume {
namespace {

void check_object(const PlacedObject& object, const GridFrame& world) {
    if (object.in_world_frame && object.grid->frame != world)
        throw Error(ErrorKind::scene,
                    "object {}: its voxels have another frame than the world that they were made "
                    "for: voxelize it in the world's frame",
                    object.object);
    if (!object.in_world_frame && surface_of(*object.grid) == Surface::exact)
        throw Error(ErrorKind::scene,
                    "object {}: an exact surface can't be resampled: voxelize it in the world's "
                    "frame",
                    object.object);
    if (object.object > VXL_OBJECT_MASK)
        throw Error(ErrorKind::limit, "object {}: a world holds at most {} objects", object.object,
                    VXL_OBJECT_MASK + 1);
}

/// The objects with the loser of every overlap before its winner; exact ones first of all, since
/// they share their voxels with smooth surfaces and lose them to cubes.
std::vector<const PlacedObject*> painting_order(std::span<const PlacedObject> objects) {
    std::vector<const PlacedObject*> order;
    for (size_t i = objects.size(); i-- > 0;) order.push_back(&objects[i]);
    std::ranges::stable_sort(order, {}, &PlacedObject::priority);
    std::stable_partition(order.begin(), order.end(), [](const PlacedObject* object) {
        return surface_of(*object->grid) == Surface::exact;
    });
    return order;
}

/// A world that is its only object: its buffers, with its word.
bool is_only_object(std::span<const PlacedObject> objects, const WorldParts& parts) {
    return objects.size() == 1 && objects[0].in_world_frame && !parts.has_words() &&
           !objects[0].keeps_inside && surface_of(*objects[0].grid) != Surface::exact;
}

}  // namespace

/// Objects placed, and their world.
class Placer::State {
  public:
    State(const Device& device, const GridFrame& frame) : device_(device) { world_.frame = frame; }

    bool continues_with(const GridFrame& frame, const WorldParts& parts) const {
        return bricks_ && frame == world_.frame && parts.is_stored_like(parts_);
    }

    /// An object's own buffers are all of the world.
    void share(const PlacedObject& object, const WorldParts& parts) {
        world_ = *object.grid;
        world_.attributes = {};
        world_.attribute = *parts.words.begin();
    }

    void place(std::span<const PlacedObject> objects, const WorldParts& parts) {
        parts_ = parts;
        std::map<uint32_t, Painter> left = std::exchange(painters_, {});
        std::vector<Painter*> changed;
        take_painters(objects, left, changed);
        for (auto& [number, painter] : left) changed.push_back(&painter);
        const bool is_first = !bricks_;
        if (is_first) bricks_.emplace(device_, parts, world_);
        const std::vector<uint32_t> bricks =
            is_first ? std::vector<uint32_t>{} : bricks_with(changed);
        const std::vector<uint32_t> slots = bricks_->store(
            bricks, is_first || !bricks.empty() ? states(bricks) : std::vector<uint8_t>{});
        paint(objects, slots);
        join_exact_surfaces(device_, objects, world_);
    }

    const BrickGrid& world() const { return world_; }
    uint32_t painted() const { return painted_; }

  private:
    /// Painters for the objects, those that didn't change from `left`.
    void take_painters(std::span<const PlacedObject> objects, std::map<uint32_t, Painter>& left,
                       std::vector<Painter*>& changed) {
        std::map<const BrickGrid*, const Painter*> of_grid;
        for (const auto& [number, painter] : left) of_grid[painter.object().grid] = &painter;
        for (const PlacedObject& object : objects) {
            const auto before = left.find(object.object);
            if (before != left.end() && before->second.object() == object) {
                painters_.insert(left.extract(before));
                continue;
            }
            const Painter*& same_grid = of_grid[object.grid];
            const auto added = painters_.try_emplace(object.object, device_, object, world_.frame,
                                                     parts_, same_grid);
            same_grid = &added.first->second;
            changed.push_back(&added.first->second);
        }
    }

    uint32_t table_size() const {
        const glm::ivec3 table = world_.frame.bricks();
        return uint32_t(table.x) * uint32_t(table.y) * uint32_t(table.z);
    }

    /// The states that objects give to the bricks listed, or to all.
    template <class Painters>
    std::vector<uint8_t> states(const std::vector<uint32_t>& listed, Painters&& painters) {
        const auto count = uint32_t(listed.empty() ? table_size() : listed.size());
        const Buffer<uint32_t> list(device_, "listed bricks", listed);
        Buffer<uint8_t> states(device_, "brick states", count);
        states.fill(0);
        for (Painter* painter : painters) painter->classify(world_.frame, count, list, states);
        return states.read();
    }

    std::vector<uint8_t> states(const std::vector<uint32_t>& listed) {
        std::vector<Painter*> all;
        for (auto& [number, painter] : painters_) all.push_back(&painter);
        return states(listed, all);
    }

    /// The bricks in which one of the painters has a part.
    std::vector<uint32_t> bricks_with(const std::vector<Painter*>& painters) {
        std::vector<uint32_t> bricks;
        if (painters.empty()) return bricks;
        const std::vector<uint8_t> found = states({}, painters);
        for (uint32_t brick = 0; brick < found.size(); ++brick)
            if (found[brick] != 0) bricks.push_back(brick);
        return bricks;
    }

    void paint(std::span<const PlacedObject> objects, const std::vector<uint32_t>& slots) {
        painted_ = uint32_t(slots.size());
        world_.transparent = parts_.transparent;
        if (!parts_.has_words() && !parts_.words.empty()) world_.attribute = *parts_.words.begin();
        PaintedBricks painted{painted_, Buffer<uint32_t>(device_, "painted bricks", slots), {}};
        bricks_->clear(painted.slots);
        if (parts_.smooth && (parts_.has_words() || parts_.colors || parts_.occupancy)) {
            painted.nearest =
                Buffer<int16_t>(device_, "nearest surfaces", size_t(painted.count) * 4096);
            painted.nearest.fill(32767);
        }
        Painter* smooth = nullptr;
        for (const PlacedObject* object : painting_order(objects)) {
            Painter& painter = painters_.at(object->object);
            painter.paint(painted, world_);
            if (painter.surface() == Surface::smooth) smooth = &painter;
        }
        if (smooth) smooth->close_distances(painted, world_);
    }

    Device device_;
    BrickGrid world_;
    WorldParts parts_;
    std::optional<WorldBricks> bricks_;     ///< none before the first placing
    std::map<uint32_t, Painter> painters_;  ///< by their objects' numbers
    uint32_t painted_ = 0;
};

Placer::Placer(const Device& device) : device_(device) {}
Placer::~Placer() = default;

const BrickGrid& Placer::place(std::span<const PlacedObject> objects, const GridFrame& world) {
    for (const PlacedObject& object : objects) check_object(object, world);
    const WorldParts parts = parts_of(objects);
    std::unique_ptr<State> state = std::move(state_);
    if (is_only_object(objects, parts)) {
        state = std::make_unique<State>(device_, world);
        state->share(objects[0], parts);
    } else {
        if (!state || !state->continues_with(world, parts))
            state = std::make_unique<State>(device_, world);
        state->place(objects, parts);
    }
    state_ = std::move(state);
    return state_->world();
}

uint32_t Placer::painted_bricks() const {
    return state_ ? state_->painted() : 0;
}

BrickGrid place(const Device& device, std::span<const PlacedObject> objects,
                const GridFrame& world) {
    return Placer(device).place(objects, world);
}

}  // namespace voxelume
