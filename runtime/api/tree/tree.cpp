// SPDX-License-Identifier: Apache-2.0
#include "runtime/api/tree/tree.hpp"

namespace voxelume::api {

JsonValue tree(bool value) {
    JsonValue result = json_value(JsonType::boolean);
    result.boolean = value;
    return result;
}

JsonValue tree(double value) {
    JsonValue result = json_value(JsonType::number);
    result.number = value;
    return result;
}

JsonValue tree(int value) {
    return tree(double(value));
}

JsonValue tree(const std::string& text) {
    JsonValue result = json_value(JsonType::string);
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
    JsonValue list = json_value(JsonType::array);
    list.items = std::move(items);
    return list;
}

JsonValue tree(const std::vector<double>& numbers) {
    std::vector<JsonValue> items;
    items.reserve(numbers.size());
    for (const double number : numbers) items.push_back(tree(number));
    return list_of(std::move(items));
}

ObjectTree::ObjectTree() : value_(json_value(JsonType::object)) {}

ObjectTree& ObjectTree::put(std::string_view key, JsonValue value) {
    value_.members.push_back({std::string(key), {0, 0}, std::move(value)});
    return *this;
}

}  // namespace voxelume::api
