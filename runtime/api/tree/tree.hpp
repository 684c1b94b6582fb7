// SPDX-License-Identifier: Apache-2.0
// Plain values -> values of a scene's document, which stand in no text.
#pragma once

#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/scene_file/document/scene_document.hpp"
#include "runtime/voxelume/scene.hpp"

namespace voxelume::api {

JsonValue tree(bool value);
JsonValue tree(double value);
JsonValue tree(int value);
JsonValue tree(const std::string& text);
JsonValue tree(const char* text);
JsonValue tree(const v1::Matrix& rows);

/// A list of numbers.
template <class Number, size_t count>
JsonValue tree(const std::array<Number, count>& numbers) {
    JsonValue list = tree(0.0);
    list.type = JsonType::array;
    for (const Number number : numbers) list.items.push_back(tree(number));
    return list;
}

JsonValue list_of(std::vector<JsonValue> items);
JsonValue tree(const std::vector<double>& numbers);

/// An object of the document, key by key in the order of calls.
class ObjectTree {
  public:
    ObjectTree();

    template <class Value>
    ObjectTree& add(std::string_view key, const Value& value) {
        return put(key, tree(value));
    }
    /// Adds a key, unless there is no value.
    template <class Value>
    ObjectTree& add(std::string_view key, const std::optional<Value>& value) {
        return value ? put(key, tree(*value)) : *this;
    }
    /// Adds a key, unless the text is empty.
    ObjectTree& add_text(std::string_view key, const std::string& text) {
        return text.empty() ? *this : put(key, tree(text));
    }
    ObjectTree& put(std::string_view key, JsonValue value);

    const JsonValue& value() const { return value_; }
    JsonValue take() { return std::move(value_); }

  private:
    JsonValue value_;
};

/// Adds the position, turn and scale of a placed thing, or its matrix. If both are given, the
/// document has both, and the reader asks for one.
template <class Placed>
void add_pose(const Placed& placed, ObjectTree& object) {
    const v1::Vec3 none{}, one{1, 1, 1};
    const bool is_posed = placed.position != none || placed.turn != none || placed.scale != one;
    if (placed.matrix) object.add("matrix", *placed.matrix);
    if (placed.matrix && !is_posed) return;
    object.add("position", placed.position).add("turn", placed.turn).add("scale", placed.scale);
}

// The parts of a description, each as the scene format has it.
JsonValue tree(const v1::Sequence& sequence);
JsonValue tree(const v1::World& world);
JsonValue tree(const v1::Material& material);  ///< without its name, like the others
JsonValue tree(const v1::Model& model);
JsonValue tree(const v1::Object& object);
JsonValue tree(const v1::Light& light);
JsonValue tree(const v1::Observer& observer);
JsonValue tree(const v1::Animation& animation);
JsonValue tree(const v1::RenderSettings& render);

/// The whole description. Throws Error::scene for two models or materials of one name.
JsonValue tree(const v1::SceneDescription& description);

}  // namespace voxelume::api
