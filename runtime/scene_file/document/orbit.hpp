// SPDX-License-Identifier: Apache-2.0
// A scene's document, seen from another side.
#pragma once

#include "runtime/scene/scene.hpp"
#include "runtime/scene_file/document/scene_document.hpp"

namespace voxelume {

/// The document of `scene` with its observer gone `degrees` to his right around the vertical axis
/// through what he looks at, or through the middle of the world if he looks at nothing. An observer
/// that the document leaves out is added. Throws Error::usage for an observer that moves.
JsonValue orbited(const JsonValue& document, const Scene& scene, double degrees);

}  // namespace voxelume
