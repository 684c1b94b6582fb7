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

#include "runtime/scene_file/scene_document.hpp"
#include "runtime/scene_file/scene_keys.hpp"

namespace voxelume {

/// Numbers from `min` to `max`; the ends belong to them unless they are open.
struct Range {
    double min;
    double max;
    bool min_is_open = false;
    bool max_is_open = false;
};

inline constexpr double kMaxLength = 1e9;  ///< metres; the largest length and coordinate in a scene
inline constexpr Range kCoordinate{-kMaxLength, kMaxLength};
inline constexpr Range kLength{0, kMaxLength, true};
inline constexpr Range kNotNegative{0, kMaxLength};
inline constexpr Range kRatio{0, 1};
inline constexpr Range kDegrees{-1e6, 1e6};

/// Text from a file, in quotes, made safe for a terminal and cut to a readable length.
std::string quote(std::string_view text);

/// ` did you mean "brick"?` for the nearest of the names, or a list of them, or nothing. Opens with
/// `; `.
std::string suggest(std::string_view text, std::span<const std::string_view> names);

/// A value of a scene file together with its path in it. Refers to the document, which must outlive
/// it.
class SceneValue {
  public:
    SceneValue(const JsonValue& value, std::string path, const std::string& file)
        : value_(&value), path_(std::move(path)), file_(&file) {}

    const JsonValue& json() const { return *value_; }
    bool is(JsonType type) const { return value_->type == type; }

    /// "file:line:column: path", to open a message with.
    std::string where() const { return where(value_->at); }
    [[noreturn]] void fail(const std::string& sentence) const;

    double number(Range range) const;
    int integer(int min, int max) const;
    bool boolean() const;
    const std::string& text() const;  ///< not empty
    glm::dvec3 vector(Range range) const;
    glm::dvec2 pair(Range range) const;
    glm::dvec3 number_or_vector(Range range) const;  ///< one number stands for three
    glm::dvec3 direction() const;  ///< unit vector along one that must not be zero
    size_t choice(std::span<const std::string_view> names) const;  ///< index of the text among them

    std::vector<SceneValue> items() const;
    /// Members of an object whose keys are the user's own names, none of them empty.
    std::vector<std::pair<std::string, SceneValue>> named_members() const;

    SceneValue member(const JsonMember& member) const;
    std::string where(TextPosition at) const;

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
    /// Throws Error::scene when both are there.
    void refuse_both(std::string_view key, std::string_view other) const;

    double number(std::string_view key, Range range, double fallback) const;
    int integer(std::string_view key, int min, int max, int fallback) const;
    glm::dvec3 vector(std::string_view key, Range range, glm::dvec3 fallback) const;
    /// A vector in single precision; for colours.
    glm::vec3 color(std::string_view key, double max, glm::vec3 fallback) const;

  private:
    const JsonMember* member(std::string_view key) const;

    SceneValue value_;
    const KeyTable* table_;
};

/// The text of a key that selects the kind of an object, as an index into `scene_kinds(prefix)`.
/// Throws Error::scene when it is missing or names no kind.
size_t kind_of(const SceneValue& value, std::string_view key, std::string_view prefix);

}  // namespace voxelume
