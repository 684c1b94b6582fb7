// SPDX-License-Identifier: Apache-2.0
// The rows of display_shapes() whose pixels are spaced evenly by angle, and functions that they
// share with other rows.
#pragma once

#include "runtime/scene/parts/display_shape.hpp"

namespace voxelume {

const DisplayShapeRow& sector_row();
const DisplayShapeRow& ball_row();

/// The slopes of a shape that a lattice isn't clipped to.
glm::dvec2 no_slopes(const Display& display);

/// Sets `near` and `far` of a pyramid or sector. Without `far` it shows the whole world.
void set_depths(const DisplayParameters& p, double world_end, const Refuse& refuse,
                Display& display);

}  // namespace voxelume
