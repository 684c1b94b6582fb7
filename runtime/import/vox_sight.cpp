// SPDX-License-Identifier: Apache-2.0
#include "runtime/import/vox_sight.hpp"

#include <algorithm>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <glm/mat3x3.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/image/srgb.hpp"
#include "runtime/import/contents.hpp"

namespace voxelume {
namespace {

// Radiance and irradiance of a strength of 1, measured in a picture of MagicaVoxel's.
constexpr double kStrength = 1.3;
constexpr double kSunSine = 0.55;     // sine of half the angle that a sun of area 1 fills
constexpr double kFogDensity = 0.05;  // absorption per voxel of the thickest fog

/// The axes X_E, up and backwards of a camera, with Y up.
glm::dmat3 axes_of(const VoxCamera& camera) {
    const double r = glm::radians(camera.roll), p = glm::radians(camera.pitch),
                 y = glm::radians(camera.yaw);
    const glm::dmat3 roll(std::cos(r), std::sin(r), 0, -std::sin(r), std::cos(r), 0, 0, 0, 1);
    const glm::dmat3 pitch(1, 0, 0, 0, std::cos(p), std::sin(p), 0, -std::sin(p), std::cos(p));
    const glm::dmat3 yaw(std::cos(y), 0, -std::sin(y), 0, 1, 0, std::sin(y), 0, std::cos(y));
    return yaw * pitch * roll;
}

/// A vector of the file with Y up.
glm::dvec3 turned(const glm::dvec3& v) {
    return {v.x, v.z, -v.y};
}

glm::dvec3 linear_light(const glm::dvec3& color) {
    return {srgb_to_linear(color.x / 255), srgb_to_linear(color.y / 255),
            srgb_to_linear(color.z / 255)};
}

double half_height(const VoxCamera& camera, double angle) {
    const double tangent = std::tan(glm::radians(angle / 2));
    const bool is_parallel =
        camera.kind == VoxCameraKind::orthographic || camera.kind == VoxCameraKind::isometric;
    if (!is_parallel) return tangent;
    // The frustum of a parallel camera is in voxels; that of a camera that was perspective is a
    // tangent.
    return camera.frustum > 1 ? camera.frustum : std::max(camera.radius * tangent, 0.5);
}

/// The display or projection of a camera that shows `half` above its middle.
std::string display_member(VoxCameraKind kind, double half, const glm::ivec2& size, double voxel) {
    switch (kind) {
        case VoxCameraKind::orthographic:
        case VoxCameraKind::isometric:
            return fmt::format("\"projection\": \"orthographic\", \"height\": {}",
                               rounded(2 * half * voxel, 6));
        case VoxCameraKind::panoramic:
            return "\"projection\": \"panoramic\"";
        default: {
            const double angle = 2 * glm::degrees(std::atan(half * size.x / size.y));
            return fmt::format("\"display\": {{\"shape\": \"pyramid\", \"angle\": {}}}",
                               rounded(std::clamp(angle, 1.0, 170.0), 8));
        }
    }
}

/// The distance by which an observer with parallel rays must step back to see all of the box.
double step_back(const Bounds& box, const glm::dvec3& position, const glm::dvec3& backwards,
                 double voxel) {
    double back = 0;
    for (int i = 0; i < 8; ++i)
        back = std::max(back, glm::dot(corner(box, i) - position, backwards) + voxel);
    return back;
}

}  // namespace

const VoxCamera* used_camera(const VoxFile& vox) {
    const auto used =
        std::ranges::find_if(vox.cameras, [](const VoxCamera& c) { return c.radius > 0; });
    return used == vox.cameras.end() ? nullptr : &*used;
}

FileObserver vox_observer(const VoxFile& vox, const Bounds& box, const glm::ivec2& size,
                          double voxel) {
    const VoxCamera* camera = used_camera(vox);
    if (camera == nullptr) return {};
    const glm::dmat3 axes = axes_of(*camera);
    const glm::dvec3 focus = voxel * turned(camera->focus);
    const double half = half_height(*camera, camera->angle.value_or(vox.render.angle));
    const std::string display = display_member(camera->kind, half, size, voxel);
    glm::dvec3 position = focus + voxel * camera->radius * axes[2];
    if (display.find("orthographic") != std::string::npos)
        position += step_back(box, position, axes[2], voxel) * axes[2];
    const std::string text = fmt::format(
        "  \"observer\": {{\"position\": {}, \"look_at\": {}, \"up\": {},\n"
        "               {}}},\n",
        json_list(rounded(position, 6)), json_list(rounded(focus, 6)),
        json_list(rounded(axes[1], 9)), display);
    return {text, position.y};
}

FileLight vox_file_light(const VoxRender& render, double voxel) {
    const double strength = kStrength * render.exposure;
    FileLight around;
    around.sun = strength * render.sun * linear_light(render.sun_color);
    around.sky = strength * render.sky * linear_light(render.sky_color);
    around.sun_spread = glm::degrees(std::asin(std::max(kSunSine * render.sun_area, 0.002)));
    if (!render.is_there) return around;
    const double pitch = glm::radians(render.sun_pitch), yaw = glm::radians(render.sun_yaw);
    around.to_sun = turned(
        {std::cos(pitch) * std::sin(yaw), -std::cos(pitch) * std::cos(yaw), std::sin(pitch)});
    around.has_ground = render.has_ground;
    around.ground = linear_light(render.ground);
    around.background =
        render.has_background ? render.exposure * linear_light(render.background) : around.sky;
    around.fog = glm::dvec3(kFogDensity * render.fog / voxel);
    around.fog_color = around.sky * linear_light(render.fog_color);
    return around;
}

}  // namespace voxelume
