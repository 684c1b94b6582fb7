// SPDX-License-Identifier: Apache-2.0
// The choice of the values of an array that are voxels.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <limits>
#include <optional>
#include <string>
#include <type_traits>

#include "runtime/io/arrays/array_voxels.hpp"
#include "runtime/io/arrays/cell_array.hpp"

namespace voxelume {

/// The smallest value of a type of up to 32 bits that isn't below `bound`; none where there isn't
/// one.
template <class Value>
std::optional<Value> first_from(double bound) {
    using Limits = std::numeric_limits<Value>;
    if constexpr (std::is_floating_point_v<Value>) {
        const auto near = Value(bound);
        return double(near) < bound ? std::nextafter(near, Limits::infinity()) : near;
    } else {
        if (!(bound <= double(Limits::max()))) return std::nullopt;
        return bound <= double(Limits::lowest()) ? Limits::lowest() : Value(std::ceil(bound));
    }
}

template <class Value>
void choose_from(const Value* row, size_t count, std::optional<Value> low, uint8_t* chosen) {
    const bool is_there = low.has_value();
    const Value bound = low.value_or(Value{});
    for (size_t i = 0; i < count; ++i) chosen[i] = is_there && row[i] >= bound;
}

/// True if the values of a row are voxels, a byte each.
template <class Value>
void choose(const Value* row, size_t count, const CellArray& array, const VoxelValues& values,
            uint8_t* chosen) {
    const double slope = array.slope, intercept = array.intercept;
    const bool is_plain = slope == 1 && intercept == 0;
    if (values.label) {
        const double label = *values.label;
        for (size_t i = 0; i < count; ++i) chosen[i] = slope * double(row[i]) + intercept == label;
    } else if (values.each_label && (std::is_floating_point_v<Value> || !is_plain)) {
        for (size_t i = 0; i < count; ++i) chosen[i] = is_label(slope * double(row[i]) + intercept);
    } else if (values.iso || (std::is_floating_point_v<Value> && !values.each_label)) {
        const double iso = values.iso.value_or(0.5);
        // Comparing as doubles would be slower, since a register holds few: 512^3 bytes take 160 ms
        // instead of 100.
        if constexpr (sizeof(Value) <= 4)
            if (is_plain) return choose_from(row, count, first_from<Value>(iso), chosen);
        for (size_t i = 0; i < count; ++i) chosen[i] = slope * double(row[i]) + intercept >= iso;
    } else if (is_plain) {
        for (size_t i = 0; i < count; ++i) chosen[i] = row[i] != 0;
    } else {
        for (size_t i = 0; i < count; ++i) chosen[i] = slope * double(row[i]) + intercept != 0;
    }
}

/// The 8-bit code of a colour's channel: of a value from 0 to 1 if `is_fraction`, else from 0 to
/// 255.
inline uint32_t code_of(double value, bool is_fraction) {
    const double v = is_fraction ? 255 * value : value;
    return uint32_t(std::lround(std::clamp(std::isnan(v) ? 0.0 : v, 0.0, 255.0)));
}

/// Packs a row of bytes that are 0 or 1 into `count` words of 16 bits, a bit for each cell.
inline void pack_row(const uint8_t* chosen, size_t count, uint16_t* words) {
    for (size_t word = 0; word < count; ++word) {
        uint64_t low = 0, high = 0;
        std::memcpy(&low, chosen + 16 * word, 8);
        std::memcpy(&high, chosen + 16 * word + 8, 8);
        // The product brings byte i to bit 56 + i.
        constexpr uint64_t kGather = 0x0102040810204080;
        words[word] = uint16_t((low * kGather >> 56) | (high * kGather >> 56 << 8));
    }
}

/// The reason why no cell is a voxel, in words for people.
inline std::string reason_for_none(const CellArray& array, const VoxelValues& values) {
    if (array.is_color()) return "has no voxel: all of its colours are black or clear";
    if (values.label) return fmt::format("no cell has the value {}", *values.label);
    if (values.iso) return fmt::format("no cell has the value {} or more", *values.iso);
    if (values.each_label) return "has no voxel: no value is a whole number but 0";
    return is_float(array.type) ? "no cell has the value 0.5 or more: give an \"iso\""
                                : "has no voxel: all of its values are 0";
}

}  // namespace voxelume
