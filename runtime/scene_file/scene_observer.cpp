// The observer with its display.
#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "runtime/scene/scene_affine.hpp"
#include "runtime/scene_file/scene_parts.hpp"

namespace voxelume {
namespace {

glm::dmat3 read_orientation(const SceneFields& fields, glm::dvec3 position) {
    fields.refuse_both("look_at", "turn");
    fields.refuse_both("up", "turn");
    if (const auto turn = fields.find("turn")) return rotation_from_turn(turn->vector(kDegrees));

    const auto up_value = fields.find("up");
    const glm::dvec3 up = up_value ? up_value->direction() : glm::dvec3(0, 1, 0);
    const auto look_at = fields.find("look_at");
    const glm::dvec3 z = look_at ? direction_to(*look_at, position) : glm::dvec3(0, 0, 1);
    const glm::dvec3 x = glm::cross(up, z);
    const double sine = glm::length(x);
    if (sine < 1e-6) {
        (look_at ? *look_at : fields.value())
            .fail(
                "the view direction is parallel to \"up\", which leaves the image's turn open; "
                "give another \"up\", such as [0, 0, 1]");
    }
    return {x / sine, glm::cross(z, x / sine), z};
}

double distance_to_farthest_corner(const World& world, glm::dvec3 position) {
    const Bounds bounds = lattice_bounds(world);
    double farthest = 0;
    for (int i = 0; i < 8; ++i)
        farthest = std::max(farthest, glm::distance(position, corner(bounds, i)));
    return farthest;
}

/// `near` and `far` of a pyramid or sector, which without a `far` shows the whole world.
void read_depths(const SceneFields& fields, double world_end, Display& display) {
    display.near = fields.number("near", kNotNegative, 0);
    display.far = fields.number("far", kLength, world_end);
    if (display.far <= display.near) {
        const auto far = fields.find("far");
        (far ? *far : fields.get("near"))
            .fail(fmt::format("nothing lies between near, {} m, and far, {} m{}", display.near,
                              display.far, far ? "" : ", the end of the world"));
    }
}

void read_angles(const SceneFields& fields, glm::ivec2 image_size, Display& display) {
    fields.refuse_both("angles", "angle");
    if (const auto angles = fields.find("angles")) {
        const auto both = angles->pair({0, 180, true, true});
        display.half_angles = glm::radians(both / 2.0);
        return;
    }
    const auto angle = fields.find("angle");
    display.square_pixels = true;
    display.half_angles.x = angle ? half_angle(*angle, 180, true) : glm::radians(20.0);
    display.half_angles.y = square_pixel_half_angle(display.half_angles.x, image_size);
}

/// How the display's voxels are ordered, and which of them it has.
void read_volume(const SceneFields& fields, Display& display) {
    using Pair = std::array<std::string_view, 2>;
    using Sights = std::array<std::string_view, 3>;
    if (const auto layout = fields.find("layout"))
        display.layout = static_cast<VolumeLayout>(layout->choice(Pair{"rays", "lattice"}));
    const bool is_lattice = display.layout == VolumeLayout::lattice;
    const auto visibility = fields.find("visibility");
    if (visibility)
        display.visibility =
            static_cast<Visibility>(visibility->choice(Sights{"observer", "outside", "all"}));
    if (display.visibility != Visibility::observer && !is_lattice)
        visibility->fail("needs \"layout\": \"lattice\": rays show what their observer sees");
    const auto clip = fields.find("clip");
    if (clip) display.cylinder = clip->choice(Pair{"shape", "cylinder"}) == 1;
    if (display.cylinder && !is_lattice)
        clip->fail("needs \"layout\": \"lattice\": rays end with their display's shape");
}

Display read_display(const SceneValue& value, const Scene& scene, glm::dvec3 position) {
    constexpr int kMaxDisplaySide = 65536;
    const double world_end = distance_to_farthest_corner(scene.world, position);
    const size_t kind = kind_of(value, "shape", "display");
    const SceneFields fields(value, fmt::format("display:{}", scene_kinds("display")[kind]));
    Display display;
    display.shape =
        static_cast<DisplayShape>(kind);  // the tables have the order of the enumeration
    switch (display.shape) {
        case DisplayShape::pyramid:
            read_angles(fields, scene.render.size, display);
            read_depths(fields, world_end, display);
            break;
        case DisplayShape::sector:
            display.half_angles = glm::dvec2(half_angle(fields.get("angle"), 360, false));
            read_depths(fields, world_end, display);
            break;
        case DisplayShape::ball:
            display.far = fields.get("radius").number(kLength);
            break;
        case DisplayShape::box: {
            const glm::dvec3 size = fields.get("size").vector(kLength);
            display.half_size = glm::dvec2(size) / 2.0;
            display.near = fields.number("near", kNotNegative, 0);
            display.far = display.near + size.z;
            break;
        }
    }
    read_volume(fields, display);
    display.voxels = {scene.render.size, 256};
    if (const auto voxels = fields.find("voxels")) {
        const auto counts = voxels->items();
        if (counts.size() != 3) voxels->fail(fmt::format("needs 3 numbers, not {}", counts.size()));
        for (int i = 0; i < 3; ++i) display.voxels[i] = counts[i].integer(1, kMaxDisplaySide);
    }
    return display;
}

}  // namespace

glm::dvec3 direction_to(const SceneValue& target, glm::dvec3 position) {
    const glm::dvec3 v = target.vector(kCoordinate) - position;
    const double distance = glm::length(v);
    if (distance == 0) target.fail("is the position itself; name a point away from it");
    return v / distance;
}

double half_angle(const SceneValue& value, double max, bool max_is_open) {
    return glm::radians(value.number({0, max, true, max_is_open}) / 2);
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

Observer read_observer(const SceneValue& value, const Scene& scene) {
    const SceneFields fields(value, "observer");
    Observer observer;
    observer.where = value.where();
    observer.position = fields.get("position").vector(kCoordinate);
    observer.world_from_observer = read_orientation(fields, observer.position);
    observer.display = read_display(fields.get("display"), scene, observer.position);
    return observer;
}

}  // namespace voxelume
