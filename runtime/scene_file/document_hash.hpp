// SPDX-License-Identifier: Apache-2.0
// A hash of what a scene's document says.
#pragma once

#include <string>

#include "runtime/scene_file/scene_document.hpp"

namespace voxelume {

/// 32 hexadecimal digits that differ wherever documents say something else about what a frame
/// shows: the order of keys, the places of values, `$schema` and the number of frames don't matter.
/// Nor do the image's size, samples and light, which are a scene's settings besides.
std::string document_hash(const JsonValue& document);

}  // namespace voxelume
