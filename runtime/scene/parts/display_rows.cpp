// SPDX-License-Identifier: Apache-2.0
// The measures of displays as rows: their keys, members and limits.
#include <array>

#include "runtime/scene/parts/display_shape.hpp"

namespace voxelume {

std::span<const ValueRow<DisplayParameters>> display_rows() {
    static constexpr std::array<ValueRow<DisplayParameters>, 6> rows = {{
        {"angles", &DisplayParameters::angles, {0, 180, true, true}},
        {"angle", &DisplayParameters::angle, {0, 180, true, true}},
        {"near", &DisplayParameters::near, kNotNegative},
        {"far", &DisplayParameters::far, kLength},
        {"radius", &DisplayParameters::radius, kLength},
        {"size", &DisplayParameters::size, kLength},
    }};
    return rows;
}

}  // namespace voxelume
