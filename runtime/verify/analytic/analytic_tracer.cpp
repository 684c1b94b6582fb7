// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/analytic/analytic_tracer.hpp"

#include <algorithm>
#include <cmath>
#include <glm/exponential.hpp>
#include <glm/geometric.hpp>
#include <stdexcept>

#include "runtime/verify/analytic/analytic_tracer_point.hpp"

namespace voxelume::oracle {
namespace {

struct Clip {
    double first, last;
};

/// Clips a line to a box.
Clip clip(const Line& line, const glm::dvec3& low, const glm::dvec3& high, double first,
          double last) {
    for (int a = 0; a < 3; ++a) {
        const double o = line.origin[a], d = line.direction[a];
        if (d == 0) {
            if (o < low[a] || o > high[a]) last = -1;
            continue;
        }
        const double p = (low[a] - o) / d, q = (high[a] - o) / d;
        first = std::max(first, std::min(p, q));
        last = std::min(last, std::max(p, q));
    }
    return {first, last};
}

double largest(const glm::dvec3& v) {
    return std::max({v.x, v.y, v.z});
}

}  // namespace

double reflectance(double cosine, double ior_before, double ior_after) {
    const double sine = ior_before / ior_after * std::sqrt(std::max(0.0, 1 - cosine * cosine));
    if (sine >= 1) return 1;
    const double beyond = std::sqrt(1 - sine * sine);
    const double s =
        (ior_before * cosine - ior_after * beyond) / (ior_before * cosine + ior_after * beyond);
    const double p =
        (ior_after * cosine - ior_before * beyond) / (ior_after * cosine + ior_before * beyond);
    return (s * s + p * p) / 2;
}

AnalyticTracer::AnalyticTracer(const Scene& scene)
    : scene_(scene),
      world_min_(scene.world.bounds.min),
      world_max_(world_min_ + glm::dvec3(scene.world.voxels) * scene.world.voxel_size) {
    if (has_density(scene.world.medium))
        throw std::invalid_argument("the analytic tracer's medium is the same everywhere");
    for (const Object& object : scene.objects) {
        const Model& model = scene.models[size_t(object.model)];
        if (!model.solid) throw std::invalid_argument("the analytic tracer takes solids only");
        solids_.emplace_back(*model.solid, object.world_from_object);
    }
}

bool AnalyticTracer::transmits(int object) const {
    const Material& m = scene_.materials[size_t(scene_.objects[size_t(object)].material)];
    return m.refraction > 0 || m.opacity < 1;
}

/// The transmitting object whose material counts: that of the highest priority, and the earlier one
/// of equals.
int AnalyticTracer::effective(const std::vector<uint8_t>& inside) const {
    int best = -1;
    for (int i = 0; i < int(inside.size()); ++i) {
        if (!inside[size_t(i)] || !transmits(i)) continue;
        if (best < 0 || scene_.objects[size_t(i)].priority > scene_.objects[size_t(best)].priority)
            best = i;
    }
    return best;
}

/// The next surface on the path. Crossings that contradict `path.inside` belong to the surface from
/// which the ray starts, whose position was rounded to lie before it, so they are skipped.
AnalyticTracer::Surface AnalyticTracer::next_surface(const Path& path) const {
    Surface next;
    next.crossing.t = path.t_last;
    for (size_t i = 0; i < solids_.size(); ++i) {
        const Crossings all = solids_[i].crossings(path.line);
        for (int k = 0; k < all.count; ++k) {
            const Crossing& crossing = all.list[size_t(k)];
            if (crossing.t < path.t || crossing.enters == bool(path.inside[i])) continue;
            if (crossing.t < next.crossing.t) next = {int(i), crossing};
            break;
        }
    }
    return next;
}

void AnalyticTracer::find_inside(Path& path) const {
    path.inside.assign(solids_.size(), 0);
    for (size_t i = 0; i < solids_.size(); ++i) {
        const Crossings all = solids_[i].crossings(path.line);
        for (int k = 0; k < all.count; ++k)
            if (all.list[size_t(k)].t < path.t) path.inside[i] = all.list[size_t(k)].enters;
        // The line was inside a slab from minus infinity on.
        if (all.count > 0 && all.list[0].t >= path.t) path.inside[i] = !all.list[0].enters;
    }
}

bool AnalyticTracer::is_hidden(const Path& path, const Surface& surface) const {
    if (!transmits(surface.object)) return false;
    std::vector<uint8_t> after = path.inside;
    after[size_t(surface.object)] ^= 1;
    return effective(path.inside) == effective(after);
}

/// Applies what the space between path.t and t absorbs and emits.
void AnalyticTracer::pass(const Path& path, double t, glm::dvec3& transmittance,
                          glm::dvec3& emitted) const {
    const double metres = t - path.t;
    const int within = effective(path.inside);
    if (within >= 0) {
        const int material = scene_.objects[size_t(within)].material;
        transmittance =
            glm::exp(-glm::dvec3(scene_.materials[size_t(material)].absorption) * metres);
        emitted = glm::dvec3(0);
    } else {
        transmittance = glm::exp(-glm::dvec3(scene_.world.medium.absorption) * metres);
        emitted = glm::dvec3(scene_.world.medium.color) * (1.0 - transmittance);
    }
}

glm::dvec3 AnalyticTracer::color(const Material& material, const glm::dvec3& position,
                                 Events& events) const {
    if (!material.checker) return material.color;
    const Checker& checker = *material.checker;
    long long sum = 0;
    for (int a = 0; a < 3; ++a)
        if (checker.size[a] > 0)
            sum += std::llround(std::floor((position[a] - checker.origin[a]) / checker.size[a]));
    events.add(uint64_t(sum));
    return sum % 2 != 0 ? checker.color : material.color;
}

AnalyticTracer::Point AnalyticTracer::point_at(const Path& path, const Surface& surface,
                                               Events& events) const {
    const size_t object = size_t(surface.object);
    Point point;
    point.material = &scene_.materials[size_t(scene_.objects[object].material)];
    point.position = path.line.origin + path.line.direction * surface.crossing.t;
    point.normal = solids_[object].normal(point.position, surface.crossing.face);
    if (glm::dot(point.normal, path.line.direction) > 0) point.normal = -point.normal;
    point.color = color(*point.material, point.position, events);
    return point;
}

glm::dvec3 AnalyticTracer::radiance(Path path, Events& events) const {
    glm::dvec3 before(0), through(1);
    for (;;) {
        const Surface surface = next_surface(path);
        glm::dvec3 transmittance, emitted;
        pass(path, surface.crossing.t, transmittance, emitted);
        before += through * emitted;
        through *= transmittance;
        path.weight *= transmittance;
        path.t = surface.crossing.t;
        events.add(uint64_t(surface.object) + 1);
        if (surface.object < 0) return before + through * glm::dvec3(scene_.world.background);
        if (!is_hidden(path, surface)) {
            if (events.object < 0) events.object = surface.object, events.t = path.t;
            return before + through * surface_radiance(path, surface, events);
        }
        path.inside[size_t(surface.object)] ^= 1;
    }
}

glm::dvec3 AnalyticTracer::surface_radiance(const Path& path, const Surface& surface,
                                            Events& events) const {
    events.add(uint64_t(surface.crossing.face) * 2 + uint64_t(surface.crossing.enters));
    const Point point = point_at(path, surface, events);
    const Material& m = *point.material;
    const double opacity = double(m.opacity);
    glm::dvec3 value(0);
    if (opacity > 0) {
        value = glm::dvec3(m.emission) +
                point.color * double(m.diffuse) * glm::dvec3(scene_.world.ambient);
        for (const Light& light : scene_.lights) value += share_of(light, path, point, events);
        Path covered = path;
        covered.weight *= opacity;
        value = opacity * (value + scattered(covered, surface, point, events));
    }
    if (opacity < 1) {
        Path behind = path;
        behind.weight *= 1 - opacity;
        behind.inside[size_t(surface.object)] ^= 1;
        const bool ends = largest(behind.weight) < scene_.render.min_weight;
        events.add(ends);
        if (!ends) value += (1 - opacity) * radiance(behind, events);
    }
    return value;
}

/// The light that reflected and refracted rays bring to a surface point, times their ratios.
glm::dvec3 AnalyticTracer::scattered(const Path& path, const Surface& surface, const Point& point,
                                     Events& events) const {
    const Material& m = *point.material;
    if (path.depth == 0) return glm::dvec3(0);
    std::vector<uint8_t> beyond = path.inside;
    beyond[size_t(surface.object)] ^= 1;
    const auto ior_in = [this](int object) {
        if (object < 0) return 1.0;
        return double(scene_.materials[size_t(scene_.objects[size_t(object)].material)].ior);
    };
    // An opaque object has an index of refraction, too: its reflectance depends on it.
    double before = ior_in(effective(path.inside)), after = ior_in(effective(beyond));
    if (!transmits(surface.object)) (surface.crossing.enters ? after : before) = double(m.ior);

    const glm::dvec3& d = path.line.direction;
    const double cosine = std::min(1.0, -glm::dot(d, point.normal)), ratio = before / after;
    const double squared = 1 - ratio * ratio * (1 - cosine * cosine);
    const bool total = squared <= 0;
    events.add(total);
    double reflection = double(m.reflection), refraction = double(m.refraction);
    if (m.fresnel) {
        const double share = reflectance(cosine, before, after);
        reflection *= share;
        refraction *= 1 - share;
    } else if (total) {
        reflection += refraction;
    }
    if (total) refraction = 0;

    glm::dvec3 sum(0);
    const auto follow = [&](double ratio_of_ray, const glm::dvec3& direction,
                            const std::vector<uint8_t>& inside) {
        if (ratio_of_ray == 0) return;
        const glm::dvec3 weight = path.weight * ratio_of_ray;
        const bool ends = largest(weight) < scene_.render.min_weight;
        events.add(ends);
        if (ends) return;
        Path next{
            {point.position, glm::normalize(direction)}, 0, 0, inside, weight, path.depth - 1};
        next.t_last = clip(next.line, world_min_, world_max_, 0, INFINITY).last;
        sum += ratio_of_ray * radiance(std::move(next), events);
    };
    follow(reflection, d + 2 * cosine * point.normal, path.inside);
    if (!total)
        follow(refraction, ratio * d + (ratio * cosine - std::sqrt(squared)) * point.normal,
               beyond);
    return sum;
}

Seen AnalyticTracer::trace(const glm::dvec3& origin, const glm::dvec3& direction, double t_first,
                           double t_last) const {
    Path path;
    path.line = {origin, direction};
    const Clip seen = clip(path.line, world_min_, world_max_, t_first, t_last);
    Events events;
    if (seen.first > seen.last) return {glm::dvec3(scene_.world.background), events.hash};
    path.t = seen.first;
    path.t_last = seen.last;
    path.depth = scene_.render.depth;
    find_inside(path);
    const glm::dvec3 light = radiance(std::move(path), events);
    return {light, events.hash, events.object, events.t};
}

}  // namespace voxelume::oracle
