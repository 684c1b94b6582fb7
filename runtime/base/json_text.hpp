// SPDX-License-Identifier: Apache-2.0
// JSON text -> nlohmann's values, whose functions call themselves once for each level of nesting:
// without a limit, a file of some hundred kilobytes exhausts the stack.
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string_view>
#include <utility>

namespace voxelume {

/// The maximum depth of objects and lists in objects and lists.
inline constexpr int kMaxJsonLevels = 64;

/// Parses JSON, with comments if `has_comments`. Returns a value that `is_discarded()` for a text
/// that isn't JSON or has more than `kMaxJsonLevels`, which it stores in `is_too_deep`.
template <class Json>
Json parse_json_text(std::string_view text, bool* is_too_deep = nullptr,
                     bool has_comments = false) {
    struct TooDeep {};
    const auto check_depth = [](int depth, typename Json::parse_event_t event, Json&) {
        const bool begins =
            event == Json::parse_event_t::object_start || event == Json::parse_event_t::array_start;
        if (begins && depth >= kMaxJsonLevels) throw TooDeep();
        return true;
    };
    try {
        return Json::parse(text.begin(), text.end(), check_depth, false, has_comments);
    } catch (const TooDeep&) {
        if (is_too_deep) *is_too_deep = true;
        return Json(Json::value_t::discarded);
    }
}

/// True if a value is an integer that the type can hold.
template <class Integer, class Json>
bool is_json_integer(const Json& value) {
    if (value.is_number_unsigned()) return std::in_range<Integer>(value.template get<uint64_t>());
    return value.is_number_integer() && std::in_range<Integer>(value.template get<int64_t>());
}

/// The integer that a value is. Throws `Json::out_of_range` for any other value and for an integer
/// that the type can't hold: the library's `get` converts all numbers, and C++ doesn't define what
/// becomes of 1e100.
template <class Integer, class Json>
Integer json_integer(const Json& value) {
    if (!is_json_integer<Integer>(value))
        throw Json::out_of_range::create(406, "not an integer in range", nullptr);
    return value.template get<Integer>();
}

}  // namespace voxelume
