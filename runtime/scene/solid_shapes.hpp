// One descriptor row for each shape of a solid.
#pragma once

#include <span>
#include <string_view>

#include "runtime/scene/solid.hpp"
#include "runtime/scene/value_row.hpp"

namespace voxelume {

/// A shape, or a way to combine parts.
struct SolidShape {
    SolidKind kind;
    std::string_view name;  ///< in scene files
    std::span<const KindKey> keys;
};

/// In the order of SolidKind.
std::span<const SolidShape> solid_shapes();
std::span<const ValueRow<Solid>> solid_rows();

/// Refuses lengths of one shape that don't go together.
void check_solid(const Solid& solid, const Refuse& refuse);

}  // namespace voxelume
