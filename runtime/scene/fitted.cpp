// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/fitted.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>
#include <vector>

#include "runtime/base/error.hpp"
#include "runtime/scene/parts/framing.hpp"
#include "runtime/scene/scene.hpp"

namespace voxelume {
namespace {

constexpr int kMaxVoxelsPerAxis = 65536;
constexpr glm::dvec3 kToLight{0.5, 0.65, -0.75};  // in the observer's coordinates

/// The number without the digits that binary fractions add: it is written with ten at most.
double decimal(double x) {
    const std::string text = fmt::format("{:.10g}", x);
    double value = x;  // the value if the decimal exceeds 64-bit floats
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

/// The power of ten whose multiples have this many digits at the size of `x`, which isn't 0.
double last_digit(double x, int digits) {
    return std::pow(10.0, std::floor(std::log10(std::abs(x))) + 1 - digits);
}

glm::dvec3 rounded(const glm::dvec3& v, double step) {
    const glm::dvec3 steps = glm::round(v / step);
    return {decimal(steps.x * step), decimal(steps.y * step), decimal(steps.z * step)};
}

/// Voxels that cover a length. Decimal fractions have no exact binary form, so a quotient within a
/// billionth of a whole number is that number: 0.6 / 0.2 gives 3 voxels, and 0.9 / 0.3 does too.
double voxels_along(double length, double voxel) {
    const double quotient = length / voxel;
    const double whole = std::round(quotient);
    return whole >= 1 && std::abs(quotient - whole) <= 1e-9 * whole ? whole : std::ceil(quotient);
}

/// Whole voxels below and above a coordinate; one within a billionth of a whole number is that.
double voxels_below(double x, double voxel) {
    const double whole = std::round(x / voxel);
    return std::abs(x / voxel - whole) <= 1e-9 * std::max(1.0, std::abs(whole))
               ? whole
               : std::floor(x / voxel);
}

double voxels_above(double x, double voxel) {
    return -voxels_below(-x, voxel);
}

/// Refuses a world that no lattice can hold, at the world's place in the text.
void refuse(const World& world, const std::string& sentence) {
    throw Error(ErrorKind::scene, "{}: {}", world.where, sentence);
}

/// "0.5", or "[0.5, 0.25, 1]" where the numbers differ.
std::string size_text(const glm::dvec3& v) {
    if (v.x == v.y && v.y == v.z) return fmt::format("{}", v.x);
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string list_text(const glm::dvec3& v) {
    return fmt::format("[{}, {}, {}]", v.x, v.y, v.z);
}

std::string world_text(const Scene& scene) {
    const World& world = scene.world;
    std::vector<std::string> members;
    if (scene.fitted.voxel_size)
        members.push_back(fmt::format("\"voxel_size\": {}", size_text(world.voxel_size)));
    if (scene.fitted.bounds)
        members.push_back(fmt::format("\"bounds\": {{\"min\": {}, \"max\": {}}}",
                                      list_text(world.bounds.min), list_text(world.bounds.max)));
    if (scene.fitted.ambient)
        members.push_back(fmt::format("\"ambient\": [{}, {}, {}]", world.ambient.r, world.ambient.g,
                                      world.ambient.b));
    if (members.empty()) return {};
    return fmt::format("\"world\": {{{}}}\n", fmt::join(members, ", "));
}

}  // namespace

void count_voxels(World& world) {
    for (int axis = 0; axis < 3; ++axis) {
        const double length = world.bounds.max[axis] - world.bounds.min[axis];
        const double count = voxels_along(length, world.voxel_size[axis]);
        if (count > kMaxVoxelsPerAxis) {
            throw Error(
                ErrorKind::limit,
                "{}: {:.0f} voxels along {} are more than {}; use voxels of at least {:.3g} m",
                world.where, count, "xyz"[axis], kMaxVoxelsPerAxis, length / kMaxVoxelsPerAxis);
        }
        world.voxels[axis] = static_cast<int>(count);
    }
}

void fit_lattice(const Bounds& objects, World& world) {
    if (world.voxel_size.x == 0) {
        const double longest = longest_side(objects);
        if (!(longest > 0))
            refuse(world,
                   "all objects are one point, which gives the world no voxel size; give it a "
                   "\"voxel_size\"");
        const double size = longest / world.resolution, step = last_digit(size, 4);
        world.voxel_size = glm::dvec3(decimal(std::ceil(size / step - 1e-6) * step));
    }
    for (int axis = 0; axis < 3; ++axis) {
        const double edge = world.voxel_size[axis];
        const double first = voxels_below(objects.min[axis], edge) - kFittedMargin;
        const double last = voxels_above(objects.max[axis], edge) + kFittedMargin;
        world.bounds.min[axis] = decimal(first * edge);
        world.bounds.max[axis] = decimal(last * edge);
        const double farthest = std::max(-world.bounds.min[axis], world.bounds.max[axis]);
        if (!(farthest <= kMaxLength))
            refuse(world, fmt::format("its objects reach {:.3g} m from the origin along {}, "
                                      "farther than {:.0g} m; move or scale them",
                                      farthest, "xyz"[axis], kMaxLength));
    }
    count_voxels(world);
}

double fitted_near(const World& world, const glm::dvec3& position, const glm::dvec3& view) {
    const Bounds bounds = lattice_bounds(world);
    double nearest = INFINITY;
    for (int i = 0; i < 8; ++i)
        nearest = std::min(nearest, glm::dot(view, corner(bounds, i) - position));
    if (!(nearest > 0)) return 0;
    const double step = last_digit(nearest, 3);
    return decimal(std::floor(nearest / step) * step);
}

void frame_observer(Scene& scene) {
    const Refuse refused = [&](std::string_view, const std::string& sentence) {
        refuse(scene.world, "no observer can be fitted: " + sentence);
    };
    Observer& observer = scene.observer;
    Display display;
    display.shape = DisplayShape::pyramid;
    DisplaySetting setting{INFINITY, proportions(scene.render)};
    const DisplayShapeRow& shape = shape_row(display);
    shape.measure({}, setting, refused, display);

    const Bounds& box = scene.fitted.shown;
    const glm::dmat3 view = view_axes({});
    const glm::dvec3 position = framing_position(box, view, kFilled * half_extent(display));
    const double distance = glm::dot(view[2], (box.min + box.max) / 2.0 - position);
    const double step = last_digit(distance, 4);
    ObserverParameters parameters;
    parameters.position = rounded(position, step);
    parameters.look_at = rounded(position + distance * view[2], step);
    place_observer(parameters, refused, observer);

    setting.world_end = distance_to_farthest_corner(scene.world, observer.position);
    parameters.display.near =
        fitted_near(scene.world, observer.position, observer.world_from_observer[2]);
    display.voxels = observer.display.voxels;
    shape.measure(parameters.display, setting, refused, display);
    observer.display = display;
    scene.fitted.look_at = *parameters.look_at;
}

void place_default_light(Scene& scene) {
    LightParameters parameters;
    const glm::dvec3 to_light =
        glm::normalize(scene.observer.world_from_observer * glm::normalize(kToLight));
    parameters.direction = rounded(-to_light, 1e-3);
    Light& light = scene.lights.front();
    const Refuse refused = [&](std::string_view, const std::string& sentence) {
        throw std::logic_error(sentence);  // the direction is a unit vector, so this can't happen
    };
    set_light(light_types()[size_t(LightKind::directional)], parameters, refused, light);
    scene.fitted.light = *parameters.direction;
}

std::string fitted_text(const Scene& scene) {
    std::string text = world_text(scene);
    if (scene.fitted.observer)
        text += fmt::format(
            "\"observer\": {{\"position\": {}, \"look_at\": {}, "
            "\"display\": {{\"shape\": \"pyramid\", \"angle\": 40, \"near\": {}}}}}\n",
            list_text(scene.observer.position), list_text(scene.fitted.look_at),
            scene.observer.display.near);
    if (scene.has_default_light)
        text += fmt::format("\"lights\": [{{\"type\": \"directional\", \"direction\": {}}}]\n",
                            list_text(scene.fitted.light));
    return text;
}

}  // namespace voxelume
