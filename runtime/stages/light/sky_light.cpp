// SPDX-License-Identifier: Apache-2.0
#include "runtime/stages/light/sky_light.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <numbers>

#include "runtime/grid/grid_arguments.hpp"
#include "runtime/opencl/float4.hpp"

namespace voxelume {
namespace {

/// The kcd/m^2 of radiance 1 in the scene: a white surface in the light of a sun of 100 klx, whose
/// intensity is 1.
constexpr double kLuminance = 100 / std::numbers::pi;

/// Preetham's coefficients A to E of Perez' formula: a slope over the turbidity, and an offset.
constexpr double kPerez[3][5][2] = {
    {{0.1787, -1.4630}, {-0.3554, 0.4275}, {-0.0227, 5.3251}, {0.1206, -2.5771}, {-0.0670, 0.3703}},
    {{-0.0193, -0.2592},
     {-0.0665, 0.0008},
     {-0.0004, 0.2125},
     {-0.0641, -0.8989},
     {-0.0033, 0.0452}},
    {{-0.0167, -0.2608},
     {-0.0950, 0.0092},
     {-0.0079, 0.2102},
     {-0.0441, -1.6537},
     {-0.0109, 0.0529}}};

/// The chromaticity of the zenith: for the powers of the turbidity from 2 down, a cubic of the
/// sun's angle from the zenith.
constexpr double kZenith[2][3][4] = {{{0.00166, -0.00375, 0.00209, 0},
                                      {-0.02903, 0.06377, -0.03202, 0.00394},
                                      {0.11693, -0.21196, 0.06052, 0.25886}},
                                     {{0.00275, -0.00610, 0.00317, 0},
                                      {-0.04214, 0.08970, -0.04153, 0.00516},
                                      {0.15346, -0.26756, 0.06670, 0.26688}}};

double zenith_chromaticity(const double (&rows)[3][4], double turbidity, double angle) {
    double sum = 0;
    for (const auto& row : rows)
        sum = sum * turbidity + ((row[0] * angle + row[1]) * angle + row[2]) * angle + row[3];
    return sum;
}

/// The value of Perez' formula at the zenith, for a sun at this angle from the zenith.
double perez_at_zenith(const double (&c)[5], double angle) {
    const double cosine = std::cos(angle);
    return (1 + c[0] * std::exp(c[1])) *
           (1 + c[2] * std::exp(c[3] * angle) + c[4] * cosine * cosine);
}

void set_daylight(const Sky& sky, SkyRecord& record) {
    const double t = sky.turbidity, angle = std::acos(-sky.direction.y);
    double c[3][5];
    for (int i = 0; i < 3; ++i)
        for (int k = 0; k < 5; ++k) c[i][k] = kPerez[i][k][0] * t + kPerez[i][k][1];
    const double chi = (4.0 / 9 - t / 120) * (std::numbers::pi - 2 * angle);
    const double luminance = (4.0453 * t - 4.9710) * std::tan(chi) - 0.2155 * t + 2.4192;
    const double at_zenith[3] = {luminance * sky.strength / kLuminance,
                                 zenith_chromaticity(kZenith[0], t, angle),
                                 zenith_chromaticity(kZenith[1], t, angle)};
    float4* const rows[3] = {&record.luminance, &record.chromaticity_x, &record.chromaticity_y};
    glm::dvec3 last, base;
    for (int i = 0; i < 3; ++i) {
        *rows[i] = {float(c[i][0]), float(c[i][1]), float(c[i][2]), float(c[i][3])};
        last[i] = c[i][4];
        base[i] = at_zenith[i] / perez_at_zenith(c[i], angle);
    }
    record.last = to_float4(last);
    record.base = to_float4(base);
}

/// The tangent of half the angle of the sun's disc.
double disc_tangent(const Sky& sky) {
    return std::tan(glm::radians(sky.angle / 2));
}

}  // namespace

int sky_feature(const Sky& sky) {
    if (sky.kind == SkyKind::map) return VXL_SKY_MAP;
    return sky.kind == SkyKind::sun ? VXL_SKY_SUN : VXL_SKY_GRADIENT;
}

SkyRecord sky_record(const Sky& sky) {
    const auto radiance = [&](const glm::vec3& color) {
        return to_float4(glm::dvec3(color) * sky.strength);
    };
    const bool is_constant = sky.kind == SkyKind::constant;
    SkyRecord record{};
    record.zenith = radiance(is_constant ? sky.color : sky.zenith);
    record.horizon = radiance(is_constant ? sky.color : sky.horizon);
    record.ground = radiance(is_constant ? sky.color : sky.ground);
    if (sky.kind != SkyKind::sun) return record;
    record.sun_direction = to_float4(-sky.direction);
    record.sun_direction.w = float(std::cos(glm::radians(sky.angle / 2)));
    const double tangent = disc_tangent(sky);
    record.sun_radiance = to_float4(glm::dvec3(sky.color) * (sky.intensity / (tangent * tangent)));
    set_daylight(sky, record);
    return record;
}

LightRecord sun_light_record(const Sky& sky, const GridFrame& world) {
    LightRecord record{};
    record.position = to_float4(-sky.direction / world.voxel_edge);
    record.direction = to_float4(sky.direction);
    record.intensity = to_float4(glm::dvec3(sky.color) * sky.intensity);
    record.kind = VXL_LIGHT_DIRECTIONAL;
    return record;
}

LightAreaRecord sun_area_record(const Sky& sky, const GridFrame& world) {
    const glm::dvec3& d = sky.direction;
    const glm::dvec3 aside = std::abs(d.y) < 0.9 ? glm::dvec3(0, 1, 0) : glm::dvec3(1, 0, 0);
    const glm::dvec3 x = glm::normalize(glm::cross(aside, d)) * disc_tangent(sky);
    LightAreaRecord record{};
    record.axis_x = to_float4(x / world.voxel_edge);
    record.axis_y = to_float4(glm::cross(d, x) / world.voxel_edge);
    record.axis_x.w = 1.0f;
    return record;
}

SkyLightStage::SkyLightStage(const Device& device, const Features& features,
                             const Buffer<MaterialRecord>& materials, const SkyView& sky)
    : materials_(materials),
      sky_(sky),
      program_(device, "sky_light.cl", features.defines(device)),
      add_(program_.kernel("add_sky_light")) {}

void SkyLightStage::add(const Pyramid& pyramid, uint32_t number, uint32_t directions,
                        RayBatch& batch, uint32_t count, ShadowQueue& queue) {
    if (!queue.count.empty()) queue.count.fill(0);
    add_.launch_packets(count, pyramid, sky_, number, directions, materials_, queue, batch, count);
}

}  // namespace voxelume
