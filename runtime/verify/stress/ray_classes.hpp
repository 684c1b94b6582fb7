// SPDX-License-Identifier: Apache-2.0
// Classes of rays that are difficult for a walk.
#pragma once

#include <array>
#include <string_view>

#include "runtime/verify/exact/exact_walk.hpp"

namespace voxelume {

enum class RayClass { random, ties, grazing, corners, parallel, diagonal, faces };

struct RayClassName {
    RayClass kind;
    const char* name;
    const char* help;
};

inline constexpr std::array kRayClasses = {
    RayClassName{RayClass::random, "random", "rays from anywhere to anywhere"},
    RayClassName{RayClass::ties, "ties", "rays between lattice points, crossing planes at one t"},
    RayClassName{RayClass::grazing, "grazing", "rays in grid planes, or units of fixed point off"},
    RayClassName{RayClass::corners, "corners", "rays through corners and edges, or units off"},
    RayClassName{RayClass::parallel, "parallel", "rays along an axis, or units off"},
    RayClassName{RayClass::diagonal, "diagonal", "rays along diagonals, or units off"},
    RayClassName{RayClass::faces, "faces", "rays from the grid's sides, in them and through"},
};

/// Ray `number` of a class in `grid`.
FixedRay ray_of_class(RayClass kind, const FixedGrid& grid, uint64_t seed, uint64_t number);

}  // namespace voxelume
