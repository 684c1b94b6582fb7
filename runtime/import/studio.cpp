// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/studio.hpp"

#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>
#include <stdexcept>

#include "runtime/import/contents.hpp"
#include "runtime/scene/light.hpp"

namespace voxelume {
namespace {

constexpr double kSunAside = 42, kSunHeight = 44;  // degrees: left of the observer, above
constexpr double kSunSpread = 2.5;                 // degrees, half of the angle that the sun fills
constexpr double kSkySpread = 58;
constexpr int kSunSpots = 12, kSkySpots = 20;
constexpr glm::dvec3 kSunColor{1, 0.97, 0.92}, kSkyColor{0.9, 0.95, 1};
constexpr double kSun = 0.92, kSky = 0.32;  // irradiance of a plane that faces them
constexpr double kAmbient = 0.2;
constexpr glm::vec3 kBackground{0.8f, 0.8f, 0.8f};
// So far away, in longest sides, that the light on the ground is even to half of a grey level.
constexpr double kDistance = 1000;
constexpr double kFarthest = 4e8;   // metres
constexpr double kBrightest = 5e8;  // the colour has what is more, as intensities end at 1e9

/// A round light far away in a direction.
struct FarLight {
    const char* name;
    glm::dvec3 towards;  ///< unit vector from the scene
    glm::dvec3 color;
    double irradiance;  ///< of a plane that faces it
    double spread;      ///< degrees
    int spots;
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

/// Adds the light to a studio, and what it gives the ground, per colour, to `on_ground`.
void add_light(const FarLight& far, const Bounds& box, Studio& studio, glm::dvec3& on_ground) {
    const glm::dvec3 middle = (box.min + box.max) / 2.0;
    const double distance = std::min(kDistance * longest_side(box), kFarthest);
    LightParameters p;
    p.position = rounded(middle + distance * far.towards, 6);
    p.look_at = rounded(middle, 6);
    p.radius = rounded(distance * std::tan(glm::radians(far.spread)), 4);
    p.light_samples = far.spots;
    Light light;
    const Refuse refused = [](std::string_view, const std::string& sentence) {
        throw std::logic_error(sentence);  // the light is far from what it looks at
    };
    set_light(light_types()[size_t(LightKind::disk)], p, refused, light);
    const glm::dvec3 ground(middle.x, box.min.y, middle.z);
    // The plane that faces the light is taken for one that lies: its cosine is that of the middle.
    const double lying = irradiance_at(light, ground);
    const double needed = far.irradiance * far.towards.y / lying;
    const double intensity = rounded(std::min(needed, kBrightest), 5);
    const glm::dvec3 color = rounded(far.color * (needed / intensity), 5);
    on_ground += color * (intensity * lying);
    studio.lights.push_back(
        fmt::format("{{\"name\": \"{}\", \"type\": \"disk\", \"position\": {}, \"look_at\": {},\n"
                    "     \"radius\": {}, \"color\": {}, \"intensity\": {}, \"spots\": {}}}",
                    far.name, json_list(p.position), json_list(*p.look_at), p.radius,
                    json_list(color), intensity, far.spots));
}

/// The direction of a longitude and latitude in degrees.
glm::dvec3 direction_of(double longitude, double latitude) {
    return -view_axes({longitude, latitude})[2];
}

/// The radius of a disk under the box that is as large as the shadows on it.
double ground_radius(const Bounds& box) {
    const glm::dvec3 size = box.max - box.min;
    return rounded(std::hypot(size.x, size.z) / 2 + 1.6 * size.y + longest_side(box) / 8, 3);
}

/// Whether a world of such voxels has room for the ground.
bool has_room(const Bounds& box, const glm::dvec3& voxel_size) {
    constexpr double kMaxVoxels = 16000;  // of its radius
    return ground_radius(box) <= kMaxVoxels * std::min(voxel_size.x, voxel_size.z);
}

void add_ground(const Bounds& box, const glm::dvec3& color, Studio& studio) {
    const glm::dvec3 middle = (box.min + box.max) / 2.0;
    const double radius = ground_radius(box);
    const double height = rounded(longest_side(box) / 32, 3);
    const glm::dvec3 position(rounded(middle.x, 6), box.min.y - height / 2, rounded(middle.z, 6));
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

}  // namespace

Studio make_studio(const Bounds& box, const glm::dvec3& voxel_size, const ImportOptions& options) {
    Studio studio;
    studio.box = box;
    studio.ambient = glm::dvec3(kAmbient);
    glm::dvec3 on_ground = studio.ambient;
    add_light({"sun", direction_of(options.from.longitude - kSunAside, kSunHeight), kSunColor, kSun,
               kSunSpread, kSunSpots},
              box, studio, on_ground);
    add_light({"sky", {0, 1, 0}, kSkyColor, kSky, kSkySpread, kSkySpots}, box, studio, on_ground);
    studio.background = options.background.value_or(kBackground);
    studio.background = rounded(studio.background, 4);
    if (options.has_ground && !options.is_lattice && options.from.latitude >= 0 &&
        has_room(box, voxel_size))
        add_ground(box, rounded(glm::min(studio.background / on_ground, glm::dvec3(1)), 4), studio);
    return studio;
}

}  // namespace voxelume
