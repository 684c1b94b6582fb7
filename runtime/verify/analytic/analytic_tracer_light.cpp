// SPDX-License-Identifier: Apache-2.0
// The part of the analytic tracer between a surface point and a light.
#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>

#include "runtime/verify/analytic/analytic_tracer_point.hpp"

namespace voxelume::oracle {
namespace {

/// The share of a spot's light along the unit vector `away` from it.
double spot_falloff(const Light& light, const glm::dvec3& away) {
    const double inner = std::cos(light.inner_half_angle), outer = std::cos(light.outer_half_angle);
    const double cosine = glm::dot(light.direction, away);
    if (cosine >= inner) return 1;
    if (cosine <= outer) return 0;
    const double s = (cosine - outer) / (inner - outer);
    return s * s * (3 - 2 * s);
}

}  // namespace

glm::dvec3 AnalyticTracer::share_of(const Light& light, const Path& path, const Point& point,
                                    Events& events) const {
    glm::dvec3 to_light = -light.direction;
    double distance = INFINITY, falloff = 1;
    if (type_of(light).has_position) {
        to_light = light.position - point.position;
        distance = glm::length(to_light);
        to_light /= distance;
        falloff = 1 / (distance * distance);
    }
    if (light.kind == LightKind::spot) {
        const double share = spot_falloff(light, -to_light);
        events.add((share > 0) + (share >= 1));
        falloff *= share;
    }
    const double cosine = glm::dot(point.normal, to_light);
    events.add(cosine > 0);
    if (cosine <= 0 || falloff == 0) return glm::dvec3(0);
    const Material& m = *point.material;
    const glm::dvec3 half = glm::normalize(to_light - path.line.direction);
    const double highlight =
        std::pow(std::max(0.0, glm::dot(point.normal, half)), double(m.shininess));
    const glm::dvec3 share =
        point.color * double(m.diffuse) * cosine + m.specular.value_or(0) * highlight;
    return share * glm::dvec3(light.intensity) * falloff *
           shadow(path, point, to_light, distance, events);
}

/// The share of light that passes on the way to a light.
glm::dvec3 AnalyticTracer::shadow(const Path& path, const Point& point, const glm::dvec3& to_light,
                                  double distance, Events& events) const {
    Path way{{point.position, to_light}, 0, distance, path.inside, glm::dvec3(1), 0};
    for (int a = 0; a < 3; ++a) {
        const double d = to_light[a], side = d > 0 ? world_max_[a] : world_min_[a];
        if (d != 0) way.t_last = std::min(way.t_last, (side - point.position[a]) / d);
    }
    const glm::dvec3 of_medium(scene_.world.medium.absorption);
    if (!scene_.render.shadows) return glm::exp(-of_medium * std::max(0.0, way.t_last));
    glm::dvec3 throughput(1);
    for (;;) {
        const Surface surface = next_surface(way);
        events.add(uint64_t(surface.object) + 1);
        const int within = effective(way.inside);
        const glm::dvec3 absorption =
            within < 0
                ? of_medium
                : glm::dvec3(
                      scene_.materials[size_t(scene_.objects[size_t(within)].material)].absorption);
        throughput *= glm::exp(-absorption * std::max(0.0, surface.crossing.t - way.t));
        if (surface.object < 0) return throughput;
        if (!is_hidden(way, surface)) {
            events.add(uint64_t(surface.crossing.face));
            const Point met = point_at(way, surface, events);
            const double a = double(met.material->opacity);
            throughput *=
                (1 - a) * ((1 - a) + a * met.color) +
                (scene_.render.filtered_shadows ? a * double(met.material->refraction) : 0);
            if (throughput == glm::dvec3(0)) return throughput;
        }
        way.t = surface.crossing.t;
        way.inside[size_t(surface.object)] ^= 1;
    }
}

}  // namespace voxelume::oracle
