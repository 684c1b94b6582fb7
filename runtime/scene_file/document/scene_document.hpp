// SPDX-License-Identifier: Apache-2.0
// JSON text -> a tree of values with their lines and columns.
#pragma once

#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/text.hpp"

namespace voxelume {

enum class JsonType : uint8_t { null, boolean, number, string, array, object };

struct JsonMember;

/// A JSON value; only the members for its `type` are filled.
struct JsonValue {
    JsonType type = JsonType::null;
    bool boolean = false;
    bool names_items = false;  ///< messages name a list's items by their names, not their indices
    TextPosition at;
    double number = 0;
    std::string text;
    std::vector<JsonValue> items;
    std::vector<JsonMember> members;  ///< in the order of the text; no key twice
};

struct JsonMember {
    std::string key;
    TextPosition at;  ///< position of the key
    JsonValue value;
};

/// A value that isn't from a text.
inline JsonValue json_value(JsonType type) {
    JsonValue value;
    value.type = type;
    value.at = {0, 0};
    return value;
}

inline constexpr int kMaxJsonDepth = 64;
inline constexpr int kMaxJsonValues = 2'000'000;

/// Parses JSON with `//` and `/* */` comments; `file` opens the messages.
///
/// Throws Error::scene, "file:line:column: sentence", for text that is not JSON, a key that stands
/// twice in one object, and more levels or values than the limits above.
JsonValue parse_json(std::string_view text, const std::string& file);

/// Removes the line of a value and of everything in it.
void forget_places(JsonValue& value);

/// Prepares a document that isn't from a scene's text: messages have no lines, and name objects and
/// lights by their names, as in "objects.ball".
void name_parts(JsonValue& document);

/// The continuation of a list's path for one of its items: "[2]", or ".ball" by its name.
std::string item_step(const JsonValue& list, size_t index);

}  // namespace voxelume
