#include "runtime/scene/light_points.hpp"

#include <cmath>
#include <numbers>

namespace voxelume {
namespace {

/// The middles of `count` equal parts of a rectangle, halved across its longer side.
void divide(glm::dvec2 middle, glm::dvec2 size, int count, std::vector<glm::dvec2>& middles) {
    if (count == 1) return middles.push_back(middle);
    const int axis = size.y > size.x ? 1 : 0;
    const int low_count = count / 2;
    const double low = size[axis] * low_count / count, first = middle[axis] - size[axis] / 2;
    const double high = size[axis] - low;
    size[axis] = low;
    middle[axis] = first + low / 2;
    divide(middle, size, low_count, middles);
    size[axis] = high;
    middle[axis] = first + low + high / 2;
    divide(middle, size, count - low_count, middles);
}

}  // namespace

std::vector<glm::dvec2> points_of_rectangle(glm::dvec2 size, int count) {
    std::vector<glm::dvec2> middles;
    divide({0, 0}, size, count, middles);
    return middles;
}

std::vector<glm::dvec2> points_of_disk(double radius, int count) {
    const double step = std::numbers::pi * (3 - std::sqrt(5.0));
    if (count == 1) return {glm::dvec2(0)};
    std::vector<glm::dvec2> points;
    for (int i = 0; i < count; ++i) {
        const double r = radius * std::sqrt((i + 0.5) / count);
        points.emplace_back(r * std::cos(i * step), r * std::sin(i * step));
    }
    return points;
}

}  // namespace voxelume
