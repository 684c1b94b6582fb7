// SPDX-License-Identifier: Apache-2.0
// What rendering quilts shares with planning them.
#pragma once

#include "runtime/scene/scene.hpp"
#include "runtime/voxelume/quilt.hpp"

namespace voxelume::api {

/// Throws what render_quilt would throw for the frame's observer before it renders a view.
void check_quilt(const Scene& scene, const v1::Quilt& quilt, int frame);

}  // namespace voxelume::api
