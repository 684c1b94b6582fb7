// SPDX-License-Identifier: Apache-2.0
// A hash of the content of a scene's document.
#pragma once

#include <string>

#include "runtime/scene_file/document/scene_document.hpp"

namespace voxelume {

/// 32 hexadecimal digits that differ between documents whose frames show different things. The
/// order of keys, the positions of values, `$schema` and the number of frames don't matter. The
/// image's size, samples and light don't matter either, since they are settings of the scene.
std::string document_hash(const JsonValue& document);

}  // namespace voxelume
