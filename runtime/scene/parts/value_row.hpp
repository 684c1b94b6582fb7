// SPDX-License-Identifier: Apache-2.0
// Descriptor rows of a scene's values: the key of each, where it lies, and what it may be.
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

/// Numbers from `min` to `max`; the ends belong to them unless they are open.
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

/// Where a value lies. An optional one has no value where the scene doesn't give it.
using Slot = std::variant<double*, float*, int*, bool*, glm::dvec2*, glm::dvec3*, glm::vec3*,
                          std::optional<double>*, std::optional<glm::dvec2>*,
                          std::optional<glm::dvec3>*, std::vector<double>*, std::filesystem::path*>;

/// Sets a value by one number for each of its components, or by one that stands for all of them;
/// true is any number but 0, and a list gets as many numbers as there are. With an `item` from 0 on
/// it sets that number of a vector alone. Files can't be set so.
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
    Member member;            ///< its default is that of a part without keys
    Range range{};            ///< of each of its numbers
    bool is_uniform = false;  ///< one number may stand for a vector's three
    bool is_animated = true;  ///< tracks may change it
    uint32_t effect = 0;      ///< what a value other than the default switches on: MaterialEffect

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
    std::optional<Range> range{};  ///< instead of that of the value's row
};

/// Refuses a value by throwing Error::scene, which begins with the value's place. `key` is that of
/// the value in its part, "" for the part itself.
using Refuse = std::function<void(std::string_view key, const std::string& sentence)>;

/// The unit vector along one, which is refused when it is zero.
glm::dvec3 unit_vector(const glm::dvec3& v, std::string_view key, const Refuse& refuse);

/// The unit vector from a position to another point, which is refused when both are the same.
glm::dvec3 unit_vector_to(const glm::dvec3& point, const glm::dvec3& position, std::string_view key,
                          const Refuse& refuse);

/// Refuses the second of two values that say the same thing, when both are given.
void refuse_both(bool has_key, std::string_view key, bool has_other, std::string_view other,
                 const Refuse& refuse);

}  // namespace voxelume
