// SPDX-License-Identifier: Apache-2.0
// The rows of display_shapes() whose images lie evenly by angles, and what they share with others.
#pragma once

#include "runtime/scene/parts/display_shape.hpp"

namespace voxelume {

const DisplayShapeRow& sector_row();
const DisplayShapeRow& ball_row();

/// The slopes of a shape that a lattice isn't clipped to.
glm::dvec2 no_slopes(const Display& display);

/// Sets `near` and `far` of a pyramid or sector, which without a `far` shows the whole world.
void set_depths(const DisplayParameters& p, double world_end, const Refuse& refuse,
                Display& display);

}  // namespace voxelume
