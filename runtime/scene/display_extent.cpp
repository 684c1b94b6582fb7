// What a display's image spans; the module for OpenVDB has it, too.
#include <glm/trigonometric.hpp>
#include <numbers>

#include "runtime/scene/observer.hpp"

namespace voxelume {

glm::dvec2 half_extent(const Display& display) {
    switch (display.shape) {
        case DisplayShape::pyramid:
            return glm::tan(display.half_angles);
        case DisplayShape::sector:
            return display.half_angles;
        case DisplayShape::ball:
            return {std::numbers::pi, std::numbers::pi / 2};
        case DisplayShape::box:
            return display.half_size;
    }
    return {};
}

}  // namespace voxelume
