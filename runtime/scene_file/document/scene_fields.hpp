// SPDX-License-Identifier: Apache-2.0
// Typed access to the values of a scene file, with messages that say where and what to do.
#pragma once

#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

#include "runtime/base/source_place.hpp"
#include "runtime/base/text.hpp"
#include "runtime/scene/parts/value_row.hpp"
#include "runtime/scene_file/document/scene_document.hpp"
#include "runtime/scene_file/document/scene_keys.hpp"

namespace voxelume {

/// A value of a scene file together with its path. Refers to the document, which must outlive it.
class SceneValue {
  public:
    SceneValue(const JsonValue& value, std::string path, const std::string& file)
        : value_(&value), path_(std::move(path)), file_(&file) {}

    const JsonValue& json() const { return *value_; }
    bool is(JsonType type) const { return value_->type == type; }

    /// The value's place, which opens messages: "file:line:column: path".
    SourcePlace where() const { return where(value_->at); }
    [[noreturn]] void fail(const std::string& sentence) const;

    double number(Range range) const;
    int integer(int min, int max) const;
    bool boolean() const;
    const std::string& text() const;  ///< not empty
    glm::dvec3 vector(Range range) const;
    glm::dvec2 pair(Range range) const;
    glm::dvec3 number_or_vector(Range range) const;  ///< one number stands for three
    /// Reads the value into a row's slot; not for files.
    void read_into(const Slot& slot, Range range, bool is_uniform) const;
    size_t choice(std::span<const std::string_view> names) const;  ///< index of the text among them

    std::vector<SceneValue> items() const;
    /// Members of an object whose keys are the user's own names, none of them empty.
    std::vector<std::pair<std::string, SceneValue>> named_members() const;

    SceneValue member(const JsonMember& member) const;
    SourcePlace where(TextPosition at) const;

  private:
    void expect(JsonType type, std::string_view expected) const;

    const JsonValue* value_;
    std::string path_;
    const std::string* file_;
};

/// An object of the scene file that has only the keys of a table.
class SceneFields {
  public:
    /// Throws Error::scene for a value that is no object and for a key that is not in the table.
    SceneFields(SceneValue value, std::string_view table);

    const SceneValue& value() const { return value_; }
    std::optional<SceneValue> find(std::string_view key) const;
    SceneValue get(std::string_view key) const;  ///< throws Error::scene when it is missing
    bool has(std::string_view key) const { return member(key) != nullptr; }
    /// Throws Error::scene if both keys are present.
    void refuse_both(std::string_view key, std::string_view other) const;

    double number(std::string_view key, Range range, double fallback) const;
    int integer(std::string_view key, int min, int max, int fallback) const;

    /// Refuses the value of a key of this object, or the object itself.
    Refuse refusal() const;

    /// Reads those values of a part that the object has.
    template <class Part>
    void read_rows(std::span<const ValueRow<Part>> rows, Part& part) const {
        for (const ValueRow<Part>& row : rows) read_row(row, row.range, part);
    }
    /// Reads those values of a part that its kind has. Throws Error::scene if a required one is
    /// missing; keys without a row are left to the caller.
    template <class Part>
    void read_kind(std::span<const KindKey> keys, std::span<const ValueRow<Part>> rows,
                   Part& part) const {
        for (const KindKey& key : keys) {
            if (key.is_required) get(key.key);
            if (const ValueRow<Part>* row = find_row(rows, key.key))
                read_row(*row, key.range.value_or(row->range), part);
        }
    }

  private:
    template <class Part>
    void read_row(const ValueRow<Part>& row, Range range, Part& part) const {
        if (const auto value = find(row.key))
            value->read_into(row.slot(part), range, row.is_uniform);
    }
    const JsonMember* member(std::string_view key) const;

    SceneValue value_;
    const KeyTable* table_;
};

/// The text of a key that selects the kind of an object, as an index into `scene_kinds(prefix)`.
/// Throws Error::scene when it is missing or names no kind.
size_t kind_of(const SceneValue& value, std::string_view key, std::string_view prefix);

}  // namespace voxelume
