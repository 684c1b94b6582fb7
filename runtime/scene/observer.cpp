#include "runtime/scene/observer.hpp"

#include <cmath>
#include <glm/trigonometric.hpp>
#include <numbers>

namespace voxelume {

double square_pixel_half_angle(double horizontal_half_angle, glm::ivec2 size) {
    return std::atan(std::tan(horizontal_half_angle) * size.y / size.x);
}

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
