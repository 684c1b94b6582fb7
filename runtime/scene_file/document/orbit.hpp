// SPDX-License-Identifier: Apache-2.0
// A scene's document, seen from another side.
#pragma once

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/document/scene_document.hpp"

namespace voxelume {

/// The document of `scene` with its observer moved `degrees` to the right around the vertical axis
/// through the point that it looks at, or through the middle of the world without such a point. If
/// the document has no observer, one is added. Throws Error::usage for an observer that moves.
JsonValue orbited(const JsonValue& document, const Scene& scene, double degrees);

}  // namespace voxelume
