// SPDX-License-Identifier: Apache-2.0
#include "runtime/scene/parts/observer.hpp"

#include <array>
#include <glm/geometric.hpp>

#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {

namespace {

/// The maximum ratio of a lens's diameter to its focus: a wider lens would send rays along its own
/// plane.
constexpr double kMaxLensRatio = 1000;

}  // namespace

std::span<const ValueRow<ObserverParameters>> observer_rows() {
    using O = ObserverParameters;
    static constexpr std::array<ValueRow<O>, 10> rows = {
        {{"position", &O::position, kCoordinate},
         {"look_at", &O::look_at, kCoordinate},
         {"up", &O::up, kCoordinate},
         {"turn", &O::turn, kDegrees},
         {"aperture", &O::aperture, kNotNegative},
         {"focus", &O::focus, kLength},
         {"blades", &O::blades, {0, 16}, false, false},
         {"shutter", &O::shutter, {0, 100}, false, false},
         {"width", &O::width, kLength},
         {"height", &O::height, kLength}}};
    return rows;
}

void place_observer(const ObserverParameters& p, const Refuse& refuse, Observer& observer) {
    observer.position = p.position;
    refuse_both(p.look_at.has_value(), "look_at", p.turn.has_value(), "turn", refuse);
    refuse_both(p.up.has_value(), "up", p.turn.has_value(), "turn", refuse);
    observer.aperture = p.aperture;
    observer.blades = p.blades;
    observer.shutter = p.shutter;
    if (p.blades == 1 || p.blades == 2)
        refuse("blades", "a lens has 3 to 16 blades, or 0 to be round");
    observer.focus = p.focus.value_or(p.look_at ? glm::distance(*p.look_at, p.position) : 0);
    if (p.aperture > 0 && !p.focus && !p.look_at)
        refuse("aperture",
               "a lens shows one distance sharp; say which by \"focus\" or \"look_at\"");
    if (observer.aperture > kMaxLensRatio * observer.focus)
        refuse("aperture", "a lens is at most 1,000 times as wide as its \"focus\" is far away");
    if (p.turn) {
        observer.world_from_observer = rotation_from_turn(*p.turn);
        return;
    }
    const glm::dvec3 up = p.up ? unit_vector(*p.up, "up", refuse) : glm::dvec3(0, 1, 0);
    const glm::dvec3 z =
        p.look_at ? unit_vector_to(*p.look_at, p.position, "look_at", refuse) : glm::dvec3(0, 0, 1);
    const glm::dvec3 x = glm::cross(up, z);
    const double sine = glm::length(x);
    if (sine < kMinUpSine)
        refuse(p.look_at ? "look_at" : "",
               "the view direction is parallel to \"up\", which leaves the image's turn open; "
               "give another \"up\", such as [0, 0, 1]");
    observer.world_from_observer = {x / sine, glm::cross(z, x / sine), z};
}

void make_pixels_square(glm::dvec2 proportions, Display& display) {
    const auto make_square = shape_row(display).make_square;
    if (display.square_pixels && make_square) make_square(proportions, display);
}

void project(const ObserverParameters& p, const DisplaySetting& setting, const Refuse& refuse,
             Observer& observer) {
    Display& display = observer.display;
    display.near = 0;
    display.far = setting.world_end;
    if (observer.projection == Projection::panoramic) {
        display.shape = DisplayShape::ball;
        return;
    }
    refuse_both(p.width.has_value(), "width", p.height.has_value(), "height", refuse);
    if (!p.width && !p.height)
        refuse("projection",
               "\"orthographic\" needs a \"width\" or \"height\": the metres that the image shows");
    display.shape = DisplayShape::box;
    display.square_pixels = true;
    display.keeps_height = p.height.has_value();
    display.half_size = glm::dvec2(p.height.value_or(p.width.value_or(0)) / 2);
    make_pixels_square(setting.proportions, display);
}

}  // namespace voxelume
