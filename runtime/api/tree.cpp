// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/tree.hpp"

namespace voxelume::api {
namespace {

/// A value that stands on no line of a text.
JsonValue value_of(JsonType type) {
    JsonValue value;
    value.type = type;
    value.at = {0, 0};
    return value;
}

}  // namespace

JsonValue tree(bool value) {
    JsonValue result = value_of(JsonType::boolean);
    result.boolean = value;
    return result;
}

JsonValue tree(double value) {
    JsonValue result = value_of(JsonType::number);
    result.number = value;
    return result;
}

JsonValue tree(int value) {
    return tree(double(value));
}

JsonValue tree(const std::string& text) {
    JsonValue result = value_of(JsonType::string);
    result.text = text;
    return result;
}

JsonValue tree(const char* text) {
    return tree(std::string(text));
}

JsonValue tree(const v1::Matrix& rows) {
    return list_of({tree(rows[0]), tree(rows[1]), tree(rows[2])});
}

JsonValue list_of(std::vector<JsonValue> items) {
    JsonValue list = value_of(JsonType::array);
    list.items = std::move(items);
    return list;
}

ObjectTree::ObjectTree() : value_(value_of(JsonType::object)) {}

ObjectTree& ObjectTree::put(std::string_view key, JsonValue value) {
    value_.members.push_back({std::string(key), {0, 0}, std::move(value)});
    return *this;
}

}  // namespace voxelume::api
