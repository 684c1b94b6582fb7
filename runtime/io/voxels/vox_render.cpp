// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_render.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdlib>

#include "runtime/base/text.hpp"

namespace voxelume {
namespace {

constexpr double kFarthestFocus = 1e6;  // voxels: objects lie no farther from the origin

double value_in(const VoxDictionary& values, const char* name, double otherwise, double low,
                double high) {
    return std::clamp(double(number_in(values, name, float(otherwise))), low, high);
}

/// Reads the numbers of a text such as "50 50"; missing or invalid ones keep their values.
void read_numbers(const VoxDictionary& values, const char* name, double low, double high,
                  glm::dvec3& numbers) {
    const std::string text = text_in(values, name);
    const char* at = text.c_str();
    for (int i = 0; i < 3; ++i) {
        char* end = nullptr;
        const double number = std::strtod(at, &end);
        if (end == at) return;
        if (std::isfinite(number)) numbers[i] = std::clamp(number, low, high);
        at = end;
    }
}

void read_color(const VoxDictionary& values, const char* name, glm::dvec3& color) {
    read_numbers(values, name, 0, 255, color);
}

bool is_on(const VoxDictionary& values, const char* name, bool otherwise = false) {
    return number_in(values, name, otherwise) != 0;
}

VoxCameraKind camera_named(const std::string& mode) {
    constexpr std::array<std::pair<const char*, VoxCameraKind>, 5> kModes = {
        {{"pers", VoxCameraKind::perspective},
         {"free", VoxCameraKind::free},
         {"orth", VoxCameraKind::orthographic},
         {"iso", VoxCameraKind::isometric},
         {"pano", VoxCameraKind::panoramic}}};
    for (const auto& [name, kind] : kModes)
        if (mode == name) return kind;
    return mode.empty() ? VoxCameraKind::perspective : VoxCameraKind::other;
}

void read_sun(const VoxDictionary& values, VoxRender& render) {
    glm::dvec3 angles(render.sun_pitch, render.sun_yaw, 0);
    read_numbers(values, "_angle", -360, 360, angles);
    render.sun_pitch = angles[0];
    render.sun_yaw = angles[1];
    render.sun = value_in(values, "_i", render.sun, 0, 1e3);
    render.sun_area = value_in(values, "_area", render.sun_area, 0, 1);
    read_color(values, "_k", render.sun_color);
}

void read_sky(const VoxDictionary& values, VoxRender& render) {
    render.sky = value_in(values, "_i", render.sky, 0, 1e3);
    read_color(values, "_k", render.sky_color);
}

void read_fog(const VoxDictionary& values, VoxRender& render) {
    render.fog = value_in(values, "_d", 0, 0, 1);
    read_color(values, "_k", render.fog_color);
}

void read_environment(const VoxDictionary& values, VoxRender& render) {
    render.sky_mode = int(value_in(values, "_mode", 0, 0, 2));
}

void read_lens(const VoxDictionary& values, VoxRender& render) {
    render.angle = value_in(values, "_fov", render.angle, 1, 170);
    if (is_on(values, "_proj")) render.not_shown.emplace("the lens's projection");
    if (is_on(values, "_aperture")) render.not_shown.emplace("the lens's aperture");
}

void read_film(const VoxDictionary& values, VoxRender& render) {
    render.exposure = value_in(values, "_expo", 1, 0, 1e3);
    if (is_on(values, "_vig")) render.not_shown.emplace("vignetting");
    if (is_on(values, "_aces")) render.not_shown.emplace("the film's tone curve (ACES)");
}

void read_bloom(const VoxDictionary& values, VoxRender& render) {
    if (is_on(values, "_scale")) render.not_shown.emplace("bloom");
}

void read_ground(const VoxDictionary& values, VoxRender& render) {
    read_color(values, "_color", render.ground);
    render.has_ground = is_on(values, "_enable", render.has_ground);
}

void read_background(const VoxDictionary& values, VoxRender& render) {
    read_color(values, "_color", render.background);
    render.has_background = is_on(values, "_enable", render.has_background);
}

/// Reads which parts are drawn, as current files have them; older files have `_enable` instead.
void read_switches(const VoxDictionary& values, VoxRender& render) {
    render.has_ground = is_on(values, "_ground", render.has_ground);
    render.has_background = is_on(values, "_bg_c", render.has_background);
    if (is_on(values, "_edge")) render.not_shown.emplace("voxels' edges");
    if (is_on(values, "_grid")) render.not_shown.emplace("the grid");
}

void read_lines(const VoxDictionary& values, VoxRender& render) {
    if (is_on(values, "_enable"))
        render.not_shown.emplace(text_in(values, "_type") == "_grid" ? "the grid"
                                                                     : "voxels' edges");
}

}  // namespace

VoxCamera take_camera(VoxContent& content) {
    content.take_int();  // its index in the list of cameras
    const VoxDictionary values = content.take_dictionary();
    VoxCamera camera;
    camera.kind = camera_named(text_in(values, "_mode"));
    read_numbers(values, "_focus", -kFarthestFocus, kFarthestFocus, camera.focus);
    glm::dvec3 angles(0);
    read_numbers(values, "_angle", -720, 720, angles);
    camera.pitch = angles[0];
    camera.yaw = angles[1];
    camera.roll = angles[2];
    camera.radius = value_in(values, "_radius", 0, 0, kFarthestFocus);
    camera.frustum = value_in(values, "_frustum", 0, 0, kFarthestFocus);
    if (values.contains("_fov")) camera.angle = value_in(values, "_fov", 45, 1, 170);
    return camera;
}

void take_render_settings(VoxContent& content, VoxRender& render) {
    using Read = void (*)(const VoxDictionary&, VoxRender&);
    constexpr std::array<std::pair<const char*, Read>, 13> kTypes = {{{"_inf", read_sun},
                                                                      {"_uni", read_sky},
                                                                      {"_env", read_environment},
                                                                      {"_fog_uni", read_fog},
                                                                      {"_fog", read_fog},
                                                                      {"_lens", read_lens},
                                                                      {"_film", read_film},
                                                                      {"_bloom", read_bloom},
                                                                      {"_ground", read_ground},
                                                                      {"_bg", read_background},
                                                                      {"_setting", read_switches},
                                                                      {"_edge", read_lines},
                                                                      {"_grid", read_lines}}};
    const VoxDictionary values = content.take_dictionary();
    const std::string type = text_in(values, "_type");
    render.is_there = true;
    for (const auto& [name, read] : kTypes)
        if (type == name) return read(values, render);
    render.not_shown.insert("settings of the type " + quote(type));
}

}  // namespace voxelume
