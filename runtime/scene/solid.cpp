#include "runtime/scene/solid.hpp"

#include <algorithm>

namespace voxelume {

bool is_infinite(const Solid& solid) {
    switch (solid.kind) {
        case SolidKind::slab:
            return true;
        case SolidKind::union_of:
            return std::any_of(solid.parts.begin(), solid.parts.end(), is_infinite);
        case SolidKind::intersection_of:
            return std::all_of(solid.parts.begin(), solid.parts.end(), is_infinite);
        case SolidKind::difference_of:
            return is_infinite(solid.parts.front());
        default:
            return false;
    }
}

}  // namespace voxelume
