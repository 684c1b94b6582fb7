// SPDX-License-Identifier: Apache-2.0
// Descriptor rows of a scene's values: the key, the location and the range of each.
//
// Readers, tracks, the tables of keys, and the tests of the schema and the manual follow the rows.
#pragma once

#include <cstdint>
#include <filesystem>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace voxelume {

/// Numbers from `min` to `max`, including the ends unless they are open.
struct Range {
    double min = 0;
    double max = 0;
    bool min_is_open = false;
    bool max_is_open = false;
};

inline constexpr double kMaxLength = 1e9;  ///< metres; the largest length and coordinate in a scene
inline constexpr Range kCoordinate{-kMaxLength, kMaxLength};
inline constexpr Range kLength{0, kMaxLength, true};
inline constexpr Range kNotNegative{0, kMaxLength};
inline constexpr Range kRatio{0, 1};
inline constexpr Range kDegrees{-1e6, 1e6};

/// The location of a value. An optional one is empty if the scene doesn't give it.
using Slot = std::variant<double*, float*, int*, bool*, glm::dvec2*, glm::dvec3*, glm::vec3*,
                          std::optional<double>*, std::optional<glm::dvec2>*,
                          std::optional<glm::dvec3>*, std::vector<double>*, std::filesystem::path*>;

/// Sets a value from one number for each of its components, or from one number for all of them;
/// true is any number but 0, and a list gets as many elements as there are numbers. With an `item`
/// of at least 0 it sets only that component of a vector. Files can't be set this way.
void put(const Slot& slot, std::span<const double> numbers, int item = -1);

/// A value of a part of the scene.
template <class Part>
struct ValueRow {
    using Member =
        std::variant<double Part::*, float Part::*, int Part::*, bool Part::*, glm::dvec2 Part::*,
                     glm::dvec3 Part::*, glm::vec3 Part::*, std::optional<double> Part::*,
                     std::optional<glm::dvec2> Part::*, std::optional<glm::dvec3> Part::*,
                     std::vector<double> Part::*, std::filesystem::path Part::*>;

    std::string_view key;     ///< in scene files
    Member member;            ///< pointer to the value; its default is that of a part without keys
    Range range{};            ///< range of each of its numbers
    bool is_uniform = false;  ///< one number may stand for a vector's three
    bool is_animated = true;  ///< tracks may change it
    uint32_t effect = 0;      ///< the MaterialEffect of a value other than the default

    Slot slot(Part& part) const {
        return std::visit([&](auto m) -> Slot { return &(part.*m); }, member);
    }
    /// True if two parts have the same value.
    bool is_equal(const Part& a, const Part& b) const {
        return std::visit([&](auto m) { return a.*m == b.*m; }, member);
    }
};

/// The row of a key, or null.
template <class Part>
const ValueRow<Part>* find_row(std::span<const ValueRow<Part>> rows, std::string_view key) {
    for (const ValueRow<Part>& row : rows)
        if (row.key == key) return &row;
    return nullptr;
}

/// A key of one kind of part, such as a type of light.
struct KindKey {
    std::string_view key;
    bool is_required = false;
    std::optional<Range> range{};  ///< replaces the range of the value's row
};

/// Refuses a value by throwing Error::scene, which begins with the value's place in the text. `key`
/// is the value's key in its part, "" for the part itself.
using Refuse = std::function<void(std::string_view key, const std::string& sentence)>;

/// The normalized vector; refuses the zero vector.
glm::dvec3 unit_vector(const glm::dvec3& v, std::string_view key, const Refuse& refuse);

/// The unit vector from a position to another point; refuses equal points.
glm::dvec3 unit_vector_to(const glm::dvec3& point, const glm::dvec3& position, std::string_view key,
                          const Refuse& refuse);

/// Refuses the second of two values with the same meaning if both are given.
void refuse_both(bool has_key, std::string_view key, bool has_other, std::string_view other,
                 const Refuse& refuse);

}  // namespace voxelume
