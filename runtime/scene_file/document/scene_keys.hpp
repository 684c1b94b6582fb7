// SPDX-License-Identifier: Apache-2.0
// The table of all keys of the scene format: the parser accepts these and no others.
#pragma once

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// Keys that one kind of JSON object may have. `name` is that of its definition in
/// scenes/voxelume.schema.json; kinds that a value selects follow a colon: "light:spot".
struct KeyTable {
    std::string name;
    std::vector<std::string_view> keys;
};

/// All tables, in the order of scenes/manual/scene.md.
const std::vector<KeyTable>& scene_key_tables();

/// The table of that name, which must exist.
const KeyTable& scene_keys(std::string_view name);

/// `suggest` for a key. Knows the words of other programs, such as "rotation" for "turn".
std::string suggest_key(std::string_view key, std::span<const std::string_view> keys);

/// The names after the colon in the tables "prefix:...": the values that select a kind.
std::vector<std::string_view> scene_kinds(std::string_view prefix);

}  // namespace voxelume
