// SPDX-License-Identifier: Apache-2.0
// Paths to values of a scene: "objects.ball.position", "models.block.parts[1].turn".
#pragma once

#include <optional>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/scene_file/document/scene_document.hpp"

namespace voxelume {

/// A step from a value to one inside of it: a key, or an index in a list if the key is empty.
struct PathStep {
    std::string key;
    size_t item = 0;
    bool operator==(const PathStep&) const = default;
};

/// The end of a message about a path that can't be read.
inline constexpr const char* kPathAdvice =
    "can't be read; write keys with dots between and places in lists in brackets, as in "
    "\"objects.ball.position\" or \"models.block.parts[1].height\"";

/// Reads a path, which begins with a key. Keys end at a dot or bracket, and may be quoted if they
/// contain one. Returns nothing for a text that is no path.
std::optional<std::vector<PathStep>> parse_path(std::string_view text);

/// Stores a value in a part at the end of these steps; a missing last key is added.
void put_value(JsonValue& part, const std::vector<PathStep>& steps, JsonValue value);

}  // namespace voxelume
