#include "runtime/scene/observer.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "runtime/scene/scene_affine.hpp"

namespace voxelume {

namespace {

/// `near` and `far` of a pyramid or sector, which without a `far` shows the whole world.
void set_depths(const DisplayParameters& p, double world_end, const Refuse& refuse,
                Display& display) {
    display.near = p.near;
    display.far = p.far.value_or(world_end);
    if (display.far <= display.near)
        refuse(p.far ? "far" : "near",
               fmt::format("nothing lies between near, {} m, and far, {} m{}", display.near,
                           display.far, p.far ? "" : ", the end of the world"));
}

void measure_pyramid(const DisplayParameters& p, const DisplaySetting& setting,
                     const Refuse& refuse, Display& display) {
    refuse_both(p.angles.has_value(), "angles", p.angle.has_value(), "angle", refuse);
    if (p.angles) {
        display.half_angles = glm::radians(*p.angles / 2.0);
    } else {
        display.square_pixels = true;
        display.half_angles.x = p.angle ? glm::radians(*p.angle / 2) : glm::radians(20.0);
        display.half_angles.y = square_pixel_half_angle(display.half_angles.x, setting.image_size);
    }
    set_depths(p, setting.world_end, refuse, display);
}

void measure_sector(const DisplayParameters& p, const DisplaySetting& setting, const Refuse& refuse,
                    Display& display) {
    display.half_angles = glm::dvec2(glm::radians(p.angle.value_or(0) / 2));
    set_depths(p, setting.world_end, refuse, display);
}

void measure_ball(const DisplayParameters& p, const DisplaySetting&, const Refuse&,
                  Display& display) {
    display.far = p.radius;
}

void measure_box(const DisplayParameters& p, const DisplaySetting&, const Refuse&,
                 Display& display) {
    display.half_size = glm::dvec2(p.size) / 2.0;
    display.near = p.near;
    display.far = display.near + p.size.z;
}

constexpr KindKey kPyramidKeys[] = {{"angles"}, {"angle"}, {"near"}, {"far"}};
constexpr KindKey kSectorKeys[] = {{"angle", true, Range{0, 360, true}}, {"near"}, {"far"}};
constexpr KindKey kBallKeys[] = {{"radius", true}};
constexpr KindKey kBoxKeys[] = {{"size", true}, {"near"}};

}  // namespace

std::span<const DisplayShapeRow> display_shapes() {
    static constexpr std::array<DisplayShapeRow, 4> shapes = {{
        {DisplayShape::pyramid, "pyramid", kPyramidKeys, measure_pyramid},
        {DisplayShape::sector, "sector", kSectorKeys, measure_sector},
        {DisplayShape::ball, "ball", kBallKeys, measure_ball},
        {DisplayShape::box, "box", kBoxKeys, measure_box},
    }};
    return shapes;
}

std::span<const ValueRow<ObserverParameters>> observer_rows() {
    using O = ObserverParameters;
    static constexpr std::array<ValueRow<O>, 4> rows = {{{"position", &O::position, kCoordinate},
                                                         {"look_at", &O::look_at, kCoordinate},
                                                         {"up", &O::up, kCoordinate},
                                                         {"turn", &O::turn, kDegrees}}};
    return rows;
}

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

void place_observer(const ObserverParameters& p, const Refuse& refuse, Observer& observer) {
    observer.position = p.position;
    refuse_both(p.look_at.has_value(), "look_at", p.turn.has_value(), "turn", refuse);
    refuse_both(p.up.has_value(), "up", p.turn.has_value(), "turn", refuse);
    if (p.turn) {
        observer.world_from_observer = rotation_from_turn(*p.turn);
        return;
    }
    const glm::dvec3 up = p.up ? unit_vector(*p.up, "up", refuse) : glm::dvec3(0, 1, 0);
    const glm::dvec3 z =
        p.look_at ? unit_vector_to(*p.look_at, p.position, "look_at", refuse) : glm::dvec3(0, 0, 1);
    const glm::dvec3 x = glm::cross(up, z);
    const double sine = glm::length(x);
    if (sine < 1e-6)
        refuse(p.look_at ? "look_at" : "",
               "the view direction is parallel to \"up\", which leaves the image's turn open; "
               "give another \"up\", such as [0, 0, 1]");
    observer.world_from_observer = {x / sine, glm::cross(z, x / sine), z};
}

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
