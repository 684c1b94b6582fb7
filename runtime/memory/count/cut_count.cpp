// SPDX-License-Identifier: Apache-2.0
#include "runtime/memory/count/cut_count.hpp"

namespace voxelume {

Solid cuts_of(const Model& model) {
    Solid cuts;
    cuts.kind = SolidKind::union_of;
    if (stores_distances(model.surface)) cuts.parts = model.cuts;
    return cuts;
}

SurfaceExtent cut_extent(const Model& model, const glm::dmat4& frame_from_model,
                         const GridFrame& frame, const VoxelBox& box, const BrickRule& rule) {
    const Solid cuts = cuts_of(model);
    if (cuts.parts.empty()) return {};
    TakenBricks taken(frame);
    return count_parts(cuts, frame_from_model, frame, box, rule, taken).extent;
}

size_t cut_bricks(const Model& model, const glm::dmat4& frame_from_model, const GridFrame& frame) {
    const VoxelBox whole{glm::dvec3(0), glm::dvec3(frame.size)};
    return size_t(
        cut_extent(model, frame_from_model, frame, whole, model_rule(model.surface, false)).bricks);
}

}  // namespace voxelume
