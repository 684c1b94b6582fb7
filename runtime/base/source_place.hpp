// SPDX-License-Identifier: Apache-2.0
// Where something stands: a file, a line and column in it, the path of a key.
#pragma once

#include <fmt/format.h>

#include <string>
#include <utility>

namespace voxelume {

/// A place that a message begins with. Parts that don't apply are empty or 0.
struct SourcePlace {
    std::string file;
    int line = 0;    ///< from 1 on
    int column = 0;  ///< from 1 on, in characters
    std::string key = {};

    SourcePlace() = default;
    // NOLINTNEXTLINE(google-explicit-constructor): a file is a place
    SourcePlace(std::string file_name) : file(std::move(file_name)) {}
    // NOLINTNEXTLINE(google-explicit-constructor)
    SourcePlace(const char* file_name) : file(file_name) {}
    SourcePlace(std::string file_name, int line_number, int column_number, std::string key_path)
        : file(std::move(file_name)),
          line(line_number),
          column(column_number),
          key(std::move(key_path)) {}

    bool empty() const { return file.empty() && key.empty(); }

    /// "room.json:12:9: objects[0].material", without the parts that it doesn't have.
    std::string text() const {
        std::string text = file;
        if (line > 0) text += fmt::format(":{}", line);
        if (column > 0) text += fmt::format(":{}", column);
        if (!key.empty()) text += text.empty() ? key : ": " + key;
        return text;
    }

    friend bool operator==(const SourcePlace&, const SourcePlace&) = default;
};

}  // namespace voxelume

/// A place in a message is its text.
template <>
struct fmt::formatter<voxelume::SourcePlace> : fmt::formatter<std::string> {
    template <class Context>
    auto format(const voxelume::SourcePlace& place, Context& context) const {
        return fmt::formatter<std::string>::format(place.text(), context);
    }
};
