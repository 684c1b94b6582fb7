// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/studio.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <stdexcept>

#include "runtime/import/contents.hpp"
#include "runtime/scene/parts/light.hpp"

namespace voxelume {
namespace {

constexpr double kSunAside = 42, kSunHeight = 44;  // degrees: left of the observer, above
constexpr double kSunSpread = 2.5;                 // degrees, half of the angle that the sun fills
constexpr int kSunLightSamples = 24;  // each of 12 drew a shadow of its own behind thin things
constexpr glm::dvec3 kSunColor{1, 0.97, 0.92}, kSkyColor{0.9, 0.95, 1};
constexpr double kSun = 0.92;  // irradiance of a plane that faces it
constexpr double kSky = 0.5;   // radiance
constexpr glm::vec3 kBackground{0.8f, 0.8f, 0.8f};
// The distance of lights, in longest sides of the box: the light on the ground is then even to half
// of a grey level.
constexpr double kDistance = 1000;
constexpr double kFarthest = 4e8;   // metres
constexpr double kBrightest = 5e8;  // the colour has the rest, as intensities end at 1e9

/// A round light far away in a direction.
struct FarLight {
    const char* name;
    glm::dvec3 towards;  ///< unit vector from the scene
    glm::dvec3 color;
    double irradiance;  ///< irradiance of a plane that faces the light
    double spread;      ///< degrees
    int samples;
};

/// The cosine-weighted light that reaches a horizontal plane at `p`.
double irradiance_at(const Light& light, const glm::dvec3& p) {
    const LightArea& shape = *type_of(light).area;
    const glm::dvec3 axis_y = glm::cross(light.direction, light.axis_x);
    const double each = 1.0 / light.light_samples;
    const double spread = shape.area(light) * each / std::numbers::pi;
    double sum = 0;
    for (const glm::dvec2& point : shape.points(light)) {
        const glm::dvec3 to_light = light.position + point.x * light.axis_x + point.y * axis_y - p;
        const double squared = glm::dot(to_light, to_light), distance = std::sqrt(squared);
        sum += each * -glm::dot(to_light, light.direction) / distance / (squared + spread) *
               to_light.y / distance;
    }
    return sum;
}

/// Adds the light to a studio, and adds what it gives the ground, per colour, to `on_ground`.
void add_light(const FarLight& far, const Bounds& box, Studio& studio, glm::dvec3& on_ground) {
    const glm::dvec3 middle = (box.min + box.max) / 2.0;
    const double distance = std::min(kDistance * longest_side(box), kFarthest);
    LightParameters p;
    p.position = rounded(middle + distance * far.towards, 6);
    p.look_at = rounded(middle, 6);
    p.radius = rounded(distance * std::tan(glm::radians(far.spread)), 4);
    p.light_samples = far.samples;
    Light light;
    const Refuse refused = [](std::string_view, const std::string& sentence) {
        throw std::logic_error(sentence);  // the light is far from what it looks at
    };
    set_light(light_types()[size_t(LightKind::disk)], p, refused, light);
    const glm::dvec3 ground(middle.x, box.min.y, middle.z);
    // The plane facing the light stands in for the horizontal one, with the cosine at its middle.
    const double lying = irradiance_at(light, ground);
    const double needed = far.irradiance * far.towards.y / lying;
    const double intensity = rounded(std::min(needed, kBrightest), 5);
    const glm::dvec3 color = rounded(far.color * (needed / intensity), 5);
    on_ground += color * (intensity * lying);
    studio.lights.push_back(
        fmt::format("{{\"name\": \"{}\", \"type\": \"disk\", \"position\": {}, \"look_at\": {},\n"
                    "     \"radius\": {}, \"color\": {}, \"intensity\": {}, \"spots\": {}}}",
                    far.name, json_list(p.position), json_list(*p.look_at), p.radius,
                    json_list(color), intensity, far.samples));
}

/// The direction of a longitude and latitude in degrees.
glm::dvec3 direction_of(double longitude, double latitude) {
    return -view_axes({longitude, latitude})[2];
}

/// The radius of a disk under the box that is large enough for the box's shadows.
double ground_radius(const Bounds& box) {
    const glm::dvec3 size = box.max - box.min;
    return rounded(std::hypot(size.x, size.z) / 2 + 1.6 * size.y + longest_side(box) / 8, 3);
}

/// The largest radius of a disk that fits a world with voxels of this size.
double max_radius(const glm::dvec3& voxel_size) {
    constexpr double kMaxVoxels = 16000;
    return kMaxVoxels * std::min(voxel_size.x, voxel_size.z);
}

/// The distance of the ground below the objects on it: invisible, but larger than the origin offset
/// of rays. Where ground and glass touched, rays out of the glass passed through the ground here
/// and there.
double ground_gap(const Bounds& box, const glm::dvec3& voxel_size) {
    return rounded(std::max(voxel_size.y / 100, longest_side(box) / 8192), 3);
}

void add_ground(const Bounds& box, double radius, double gap, const glm::dvec3& color,
                Studio& studio) {
    const glm::dvec3 middle = (box.min + box.max) / 2.0;
    // Cameras that stand low would see the side of a thick disk.
    const double height = rounded(longest_side(box) / 8192, 3);
    const double level = rounded(box.min.y - gap - height / 2, 12);
    const glm::dvec3 position(rounded(middle.x, 6), level, rounded(middle.z, 6));
    studio.materials.push_back(fmt::format("\"ground\": {{\"color\": {}}}", json_list(color)));
    studio.models.push_back(
        fmt::format("\"ground\": {{\"shape\": \"cylinder\", \"radius\": {}, \"height\": {},\n"
                    "               \"surface\": \"exact\", \"voxel_size\": {}}}",
                    radius, height, rounded(radius / 16, 3)));
    studio.objects.push_back(
        fmt::format("{{\"name\": \"ground\", \"model\": \"ground\", \"material\": \"ground\",\n"
                    "     \"position\": {}, \"placement\": \"instance\"}}",
                    json_list(position)));
    const glm::dvec3 reach(radius, height / 2, radius);
    studio.box = {glm::min(box.min, position - reach), glm::max(box.max, position + reach)};
}

/// A sky of one colour that observers don't see.
std::string hidden_sky(const glm::dvec3& color) {
    return fmt::format(
        ",\n            \"sky\": {{\"kind\": \"constant\", \"color\": {}, \"visible\": false}}",
        json_list(rounded(color, 4)));
}

/// Adds the studio's own light. Returns the part of it that reaches the ground, per colour.
glm::dvec3 add_own_light(const Bounds& box, double longitude, double ambient, Studio& studio) {
    const glm::dvec3 sky = kSky * kSkyColor;
    studio.sky = hidden_sky(sky);
    studio.ambient = glm::dvec3(ambient);
    glm::dvec3 on_ground = sky + ambient;
    add_light({"sun", direction_of(longitude - kSunAside, kSunHeight), kSunColor, kSun, kSunSpread,
               kSunLightSamples},
              box, studio, on_ground);
    return on_ground;
}

/// Adds the light of a file. A sun that doesn't stand above the horizon doesn't shine.
glm::dvec3 add_light_of(const FileLight& around, const Bounds& box, double longitude,
                        Studio& studio) {
    constexpr double kLowest = 0.02;  // sine of the sun's height
    glm::dvec3 on_ground = around.sky;
    const glm::dvec3 to_sun =
        around.to_sun.value_or(direction_of(longitude - kSunAside, kSunHeight));
    const double sun = std::max({around.sun.x, around.sun.y, around.sun.z});
    if (sun > 0 && to_sun.y > kLowest)
        add_light({"sun", to_sun, around.sun / sun, sun, around.sun_spread, kSunLightSamples}, box,
                  studio, on_ground);
    if (around.sky != glm::dvec3(0)) studio.sky = hidden_sky(around.sky);
    if (around.fog != glm::dvec3(0))
        studio.medium =
            fmt::format(",\n            \"medium\": {{\"absorption\": {}, \"color\": {}}}",
                        json_list(rounded(around.fog, 6)), json_list(rounded(around.fog_color, 4)));
    return on_ground;
}

/// The ground's colour: the file's, unless the options choose the background.
glm::dvec3 ground_color(const std::optional<glm::dvec3>& own, const glm::dvec3& background,
                        const glm::dvec3& on_ground, const ImportOptions& options) {
    if (own && !options.background) return rounded(*own, 4);
    return rounded(glm::min(background / glm::max(on_ground, glm::dvec3(1e-3)), glm::dvec3(1)), 4);
}

}  // namespace

Studio make_studio(const Bounds& box, const glm::dvec3& voxel_size, const ViewFrom& from,
                   const ImportOptions& options, const std::optional<FileLight>& file_light,
                   double ambient) {
    constexpr double kFarGround = 30;  // longest sides to the end of a ground that has an end
    Studio studio;
    studio.box = box;
    const FileLight around = file_light.value_or(FileLight());
    const glm::dvec3 on_ground = file_light ? add_light_of(around, box, from.longitude, studio)
                                            : add_own_light(box, from.longitude, ambient, studio);
    studio.background = kBackground;
    if (around.background) studio.background = *around.background;
    if (options.background) studio.background = *options.background;
    studio.background = rounded(studio.background, 4);
    const double radius = ground_radius(box), max_ground = max_radius(voxel_size);
    const bool has_ground =
        options.has_ground.value_or(around.has_ground && !options.is_transparent);
    if (!has_ground || options.is_lattice || from.latitude < 0 || radius > max_ground)
        return studio;
    const glm::dvec3 color = ground_color(around.ground, studio.background, on_ground, options);
    const bool ends = around.ground && !options.background;
    add_ground(box,
               ends ? std::min(rounded(kFarGround * longest_side(box), 3), max_ground) : radius,
               ground_gap(box, voxel_size), color, studio);
    return studio;
}

}  // namespace voxelume
