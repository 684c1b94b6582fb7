// SPDX-License-Identifier: Apache-2.0
// A closed white room whose walls identify where light met them, and parallel rays through the
// room. A red, a green and a blue light illuminate every point of a wall in proportions that no
// other point of that wall has. So the colour of a pixel tells where its path ended, and how much
// light it lost.
#pragma once

#include <gtest/gtest.h>

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <nlohmann/json.hpp>
#include <optional>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

using Json = nlohmann::json;

inline constexpr double kWall = 0.5;  ///< the walls' distance from the middle, metres
inline const std::array<glm::dvec3, 3> kSensorLights{
    {{-0.3, 0.2, 0.1}, {0.25, 0.3, -0.2}, {0.1, -0.35, 0.3}}};  ///< red, green, blue; 1 at 1 m

/// The empty room as a scene file. Shadows are off, so lights shine through everything.
inline Json sensor_room(double voxel_size = 0.02) {
    Json scene = Json::parse(R"({"voxelume": 1,
"world": {"bounds": {"min": [-0.6, -0.6, -0.6], "max": [0.6, 0.6, 0.6]}, "background": [1e6, 1e6, 1e6]},
"materials": {"wall": {"color": [1, 1, 1]},
              "glass": {"diffuse": 0, "refraction": 1, "ior": 1.5}},
"models": {"room": {"shape": "difference", "surface": "exact", "parts": [
              {"shape": "box", "size": [1.1, 1.1, 1.1]}, {"shape": "box", "size": [1, 1, 1]}]}},
"objects": [{"model": "room", "material": "wall"}],
"lights": [],
"observer": {"display": {"shape": "box"}},
"render": {"depth": 8, "shadows": false, "least_weight": 0}})");
    scene["world"]["voxel_size"] = voxel_size;
    for (size_t i = 0; i < 3; ++i) {
        Json light = {{"type", "point"}, {"color", {0, 0, 0}}};
        light["position"] = {kSensorLights[i].x, kSensorLights[i].y, kSensorLights[i].z};
        light["color"][i] = 1;
        scene["lights"].push_back(light);
    }
    return scene;
}

/// Adds an object with its own model.
inline void add_thing(Json& scene, const Json& model, const char* material,
                      const glm::dvec3& position, const Json& more = Json::object()) {
    const std::string name = "thing " + std::to_string(scene["objects"].size());
    scene["models"][name] = model;
    Json object = more;
    object["model"] = name;
    object["material"] = material;
    object["position"] = {position.x, position.y, position.z};
    scene["objects"].push_back(object);
}

/// Sends parallel rays along `ahead` from a square of `side` metres around `position`.
inline void send_rays(Json& scene, const glm::dvec3& position, const glm::dvec3& ahead, double side,
                      int pixels) {
    const glm::dvec3 target = position + ahead;
    scene["observer"]["position"] = {position.x, position.y, position.z};
    scene["observer"]["look_at"] = {target.x, target.y, target.z};
    scene["observer"]["display"]["size"] = {side, side, 9};
    scene["render"]["size"] = {pixels, pixels};
}

/// The result of one of the parallel rays.
struct SensedRay {
    glm::dvec3 origin, direction;
    glm::dvec3 color;
};

/// Renders a scene and reads its rays' results from their colours.
inline std::vector<SensedRay> sense(const Json& text) {
    const Scene scene = parse_scene(text.dump(), "sensor room", {});
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    const glm::dmat3& axes = scene.observer.world_from_observer;
    std::vector<SensedRay> rays;
    for (int row = 0; row < image.height; ++row)
        for (int column = 0; column < image.width; ++column) {
            const double right = 2 * (column + 0.5) / image.width - 1;
            const double up = 1 - 2 * (row + 0.5) / image.height;
            const glm::dvec2 at = glm::dvec2(-right, up) * scene.observer.display.half_size;
            const size_t pixel = rays.size();
            rays.push_back({scene.observer.position + axes[0] * at.x + axes[1] * at.y,
                            axes[2],
                            {image.planes.at("R")[pixel], image.planes.at("G")[pixel],
                             image.planes.at("B")[pixel]}});
        }
    return rays;
}

/// A point on a wall across axis `axis`.
struct WallPoint {
    glm::dvec3 position;
    int axis;
};

/// The point where a ray in the room meets a wall.
inline WallPoint wall_behind(const glm::dvec3& origin, const glm::dvec3& direction) {
    double t = INFINITY;
    int axis = 0;
    for (int a = 0; a < 3; ++a) {
        const double along = (std::copysign(kWall, direction[a]) - origin[a]) / direction[a];
        if (direction[a] != 0 && along < t) t = along, axis = a;
    }
    return {origin + t * direction, axis};
}

/// The point that a wall's colour identifies, and the ratio of the measured squared distance to the
/// red light to the actual one: 1 if no light was lost. `wall` says which wall it is.
struct Reading {
    glm::dvec3 position;
    double excess;
};

inline Reading read_color(const glm::dvec3& color, const WallPoint& wall) {
    const int a = wall.axis, u = (a + 1) % 3, v = (a + 2) % 3;
    glm::dvec3 squared;  // squared distances: a light's share is height / distance^3
    for (int i = 0; i < 3; ++i) {
        const double height = std::abs(kSensorLights[size_t(i)][a] - wall.position[a]);
        squared[i] = std::pow(height / color[i], 2.0 / 3);
    }
    // Differences of squared distances are linear in the point.
    double m[2][2], r[2];
    for (size_t i = 0; i < 2; ++i) {
        const glm::dvec3 &p = kSensorLights[i + 1], &q = kSensorLights[0];
        m[i][0] = 2 * (p[u] - q[u]), m[i][1] = 2 * (p[v] - q[v]);
        r[i] = squared[0] - squared[int(i) + 1] + glm::dot(p, p) - glm::dot(q, q) -
               2 * (p[a] - q[a]) * wall.position[a];
    }
    const double determinant = m[0][0] * m[1][1] - m[0][1] * m[1][0];
    glm::dvec3 place = wall.position;
    place[u] = (r[0] * m[1][1] - r[1] * m[0][1]) / determinant;
    place[v] = (m[0][0] * r[1] - m[1][0] * r[0]) / determinant;
    const glm::dvec3 away = place - kSensorLights[0];
    return {place, squared[0] / glm::dot(away, away)};
}

}  // namespace voxelume
