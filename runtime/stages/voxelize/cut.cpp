// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/voxelize/cut.hpp"

#include <CL/cl_platform.h>

#include <algorithm>
#include <glm/common.hpp>
#include <glm/gtc/matrix_transform.hpp>
#include <utility>

#include "runtime/geometry/solid/solid_parts.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/stages/brick_arrays.hpp"
#include "runtime/stages/voxelize/voxelize_solid.hpp"

namespace voxelume {
namespace {

constexpr uint32_t kWhite = 0x00FFFFFF;
/// The extent of cut space beyond the frame, in voxels. Distances don't matter beyond it.
constexpr double kFarVoxels = 64;

/// The part of a brick that a grid fills. An intersection has the smaller of two parts, a union the
/// larger.
enum class Share { none, some, all };

Share share_of(uint32_t slot) {
    return slot == kBrickOutside ? Share::none : (slot == kBrickInside ? Share::all : Share::some);
}

Share both(Share a, Share b) {
    return std::min(a, b);
}

Share either(Share a, Share b) {
    return std::max(a, b);
}

/// Makes the grid of the bricks that both operands fill partly.
class Joiner {
  public:
    Joiner(const Device& device, const BrickGrid& body)
        : device_(device), code_(device, "cut.cl", {}), body_(body) {
        grid_.frame = body.frame;
        grid_.attribute = body.attribute;
        grid_.transparent = body.transparent;
    }

    BrickGrid covers(const BrickGrid& inside, const CoveredBody& rest) {
        const std::vector<uint32_t> a = body_.slots.read(), a_in = inside.slots.read(),
                                    b = rest.cover.slots.read(), b_in = rest.inside.slots.read();
        std::vector<cl_uint4> sources;
        store_bricks(a, [&](size_t brick) {
            const Share of_a = share_of(a[brick]), of_b = share_of(b[brick]);
            return either(both(of_a, either(of_b, share_of(b_in[brick]))),
                          both(of_b, either(of_a, share_of(a_in[brick]))));
        });
        sources.reserve(bricks_.size());
        for (const uint32_t brick : bricks_)
            sources.push_back({{a[brick], a_in[brick], b[brick], b_in[brick]}});
        const size_t leaves = size_t(grid_.brick_count) * kLeavesPerBrick;
        grid_.occupancy = allocate_masks(device_, "occupancy", grid_.brick_count);
        code_.kernel("join_covers")
            .launch(WorkItem::light, leaves, grid_.brick_count, uploaded(sources), body_.occupancy,
                    inside.occupancy, rest.cover.occupancy, rest.inside.occupancy, grid_.occupancy);
        if (!body_.normals.empty()) {
            grid_.normals = allocate_words(device_, "voxel normals", grid_.brick_count);
            code_.kernel("join_normals")
                .launch(WorkItem::heavy, grid_.brick_count, grid_.brick_count, uploaded(sources),
                        body_.normals, rest.cover.normals, grid_.normals);
        }
        return finish();
    }

  private:
    /// Stores the bricks that are partly filled. `body` holds the body's slots.
    void store_bricks(const std::vector<uint32_t>& body, const auto& share) {
        std::vector<uint32_t> slots(body.size());
        for (size_t brick = 0; brick < slots.size(); ++brick) {
            switch (share(brick)) {
                case Share::none:
                    slots[brick] = kBrickOutside;
                    break;
                case Share::all:
                    slots[brick] = kBrickInside;
                    break;
                case Share::some:
                    slots[brick] = static_cast<uint32_t>(bricks_.size());
                    bricks_.push_back(static_cast<uint32_t>(brick));
                    body_slots_.push_back(body[brick]);
            }
        }
        grid_.brick_count = static_cast<uint32_t>(bricks_.size());
        grid_.slots = Buffer<uint32_t>(device_, "slots", slots);
        grid_.coordinates = Buffer<uint32_t>(device_, "coordinates", bricks_);
    }

    template <class Slots>
    Buffer<uint32_t> uploaded(const std::vector<Slots>& sources) const {
        const auto* words = reinterpret_cast<const uint32_t*>(sources.data());
        return {device_, "source slots",
                std::span(words, sources.size() * sizeof(Slots) / sizeof(uint32_t))};
    }

    Buffer<uint32_t> kept_words(const char* name, const Buffer<uint32_t>& from, uint32_t word) {
        Buffer<uint32_t> words = allocate_words(device_, name, grid_.brick_count);
        const Buffer<uint32_t> slots(device_, "source slots", body_slots_);
        code_.kernel("keep_words")
            .launch(WorkItem::heavy, grid_.brick_count, grid_.brick_count, slots, from, word,
                    words);
        return words;
    }

    BrickGrid finish() {
        if (!body_.attributes.empty())
            grid_.attributes = kept_words("voxel attributes", body_.attributes, body_.attribute);
        if (!body_.colors.empty()) grid_.colors = kept_words("voxel colors", body_.colors, kWhite);
        return std::move(grid_);
    }

    Device device_;
    Program code_;
    const BrickGrid& body_;
    std::vector<uint32_t> bricks_, body_slots_;  // for each stored brick
    BrickGrid grid_;
};

}  // namespace

Solid rest_of(const GridFrame& frame, const glm::dmat4& frame_from_model,
              const std::vector<Solid>& cuts) {
    const glm::dvec3 extent = glm::dvec3(frame.bricks() * kBrickSize) * frame.voxel_edge;
    Solid space;
    space.kind = SolidKind::box;
    space.size = extent + 2 * kFarVoxels * frame.voxel_edge;
    space.parent_from_solid = glm::translate(glm::dmat4(1), frame.origin + 0.5 * extent);
    Solid rest;
    rest.kind = SolidKind::difference_of;
    rest.parts.push_back(space);
    for (const Solid& cut : cuts) {
        rest.parts.push_back(cut);
        rest.parts.back().parent_from_solid = frame_from_model * cut.parent_from_solid;
    }
    return rest;
}

BrickGrid cut_field(const Device& device, std::shared_ptr<const BrickGrid> body,
                    const Solid& rest) {
    const GridFrame frame = body->frame;
    std::vector<GridPart> parts;
    for (const SolidPart& part : parts_behind_first(rest)) {
        if (parts.empty()) {  // the space around the frame
            parts.push_back({std::move(body), part.place});
            continue;
        }
        BrickGrid grid =
            voxelize_part(device, part.solid, part.is_complement, glm::dmat4(1), frame);
        parts.push_back({std::make_shared<const BrickGrid>(std::move(grid)), part.place});
    }
    BrickGrid left = with_parts(std::move(parts));
    if (left.brick_count > 0) return left;
    return voxelize_part(device, rest, false, glm::dmat4(1), frame);  // an empty grid
}

BrickGrid common_cubes(const Device& device, const CoveredBody& body, const CoveredBody& rest) {
    return Joiner(device, body.cover).covers(body.inside, rest);
}

}  // namespace voxelume
