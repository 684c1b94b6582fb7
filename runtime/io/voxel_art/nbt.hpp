// SPDX-License-Identifier: Apache-2.0
// Named binary tags, the tree of values in Minecraft's files. Numbers are big-endian.
#pragma once

#include <string_view>
#include <vector>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

struct NbtMember;

/// A value of the tree. Texts and arrays lie in the bytes that were parsed, which outlive it.
struct NbtValue {
    enum class Kind : uint8_t {
        none,
        i8,
        i16,
        i32,
        i64,
        f32,
        f64,
        bytes,
        text,
        list,
        compound,
        ints,
        longs
    };
    Kind kind = Kind::none;
    int64_t number = 0;              ///< value of whole numbers
    std::string_view content;        ///< bytes of texts and arrays, as in the file
    std::vector<NbtMember> members;  ///< members of compounds
    std::vector<NbtValue> items;     ///< items of lists

    /// A member; null where there is none.
    const NbtValue* find(std::string_view name) const;
    /// A member of the given kind. Throws Error::input where there is none.
    const NbtValue& get(std::string_view name, Kind of, const InputFile& file) const;
    /// A member that is a whole number. Throws Error::input where there is none.
    int64_t whole(std::string_view name, const InputFile& file) const;

    size_t ints() const { return content.size() / 4; }   ///< number of values of an array of ints
    size_t longs() const { return content.size() / 8; }  ///< number of values of an array of longs
    uint64_t long_at(size_t i) const;
};

struct NbtMember {
    std::string_view name;
    NbtValue value;
};

/// The compound at the root. Throws Error::input for bytes that are damaged or truncated, for a
/// tree that is deeper than 64, and for one of more than a million values.
NbtValue parse_nbt(std::string_view bytes, const InputFile& file);

}  // namespace voxelume
