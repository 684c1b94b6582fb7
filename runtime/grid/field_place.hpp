// SPDX-License-Identifier: Apache-2.0
// Where the distances of a part stand in the formula of its solid, such as a - b | (c - d).
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

#include <kernels/shared/field_place.h>

namespace voxelume {

/// The operation that joins a field's distances with those before it: the minimum or maximum
/// of the two; kernels/shared/field_place.h has the numbers.
enum class FieldLink : uint8_t { none, minimum, maximum };

/// The depth to which the brackets of a formula may be nested.
inline constexpr size_t kMaxBracketDepth = VXL_MAX_BRACKETS;
/// The maximum number of brackets in a formula.
inline constexpr size_t kMaxBrackets = VXL_BRACKET_MASK;

/// A bracket of a formula.
struct FieldBracket {
    uint32_t number = 0;               ///< from 1 on; differs from those of the formula's others
    FieldLink link = FieldLink::none;  ///< link to what stands before the bracket

    friend bool operator==(const FieldBracket&, const FieldBracket&) = default;
};

/// The place of a part in its formula, whose parts are joined from left to right except for
/// brackets. Any parts may be left out of a formula: a link counts only where something stands
/// before it.
struct FieldPlace {
    FieldLink link = FieldLink::none;    ///< link to what stands before the part in its bracket
    std::vector<FieldBracket> brackets;  ///< the brackets around the part, the outermost first

    friend bool operator==(const FieldPlace&, const FieldPlace&) = default;

    /// The brackets, as VXL_SHARED_BRACKETS reads them.
    uint32_t path() const {
        uint32_t packed = 0;
        for (size_t i = 0; i < brackets.size(); ++i)
            packed |= brackets[i].number << (VXL_BRACKET_BITS * i);
        return packed;
    }
    /// The links of the brackets and then the part's own, VXL_LINK_BITS each.
    uint32_t links() const {
        uint32_t packed = uint32_t(link) << (VXL_LINK_BITS * brackets.size());
        for (size_t i = 0; i < brackets.size(); ++i)
            packed |= uint32_t(brackets[i].link) << (VXL_LINK_BITS * i);
        return packed;
    }
};

}  // namespace voxelume
