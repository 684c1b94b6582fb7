// SPDX-License-Identifier: Apache-2.0
// A shipped scene, once with all objects in the world and once with all as instances, and the
// reasons why its two pictures differ, pixel by pixel.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/gtx/component_wise.hpp>
#include <string>
#include <vector>

#include "runtime/analysis/culling.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/predicates.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// Why a pixel differs between the two pictures. Each cause is checked at the pixel.
enum class Cause {
    none,      ///< the pixels are equal
    touch,     ///< two objects' surfaces pass through the point that it shows, so either is seen
    cut,       ///< the world's bounds cut the object: closed in the world, open in an instance
    lattice,   ///< the object's voxels lie elsewhere in its own space, within the promised distance
    sampled,   ///< samples of emissive objects, the sky or paths, or checkers at a border of their
               ///< fields: without these, the pixels are equal
    others,    ///< light of objects with other voxels: with these in the world, pixels are equal
    edge,      ///< the world's picture changes as much if rays move by a ten-thousandth voxel
    far_edge,  ///< like edge, for a hundredth: where light grazes a surface, or rays continue from
               ///< curved surfaces, rounding grows
    unexplained
};
inline constexpr std::array<const char*, size_t(Cause::unexplained) + 1> kCauseNames = {
    "the same",      "touch",          "cut",        "other voxels",
    "sampled light", "others' voxels", "at an edge", "farther from an edge",
    "unexplained"};

/// The maximum distance of a surface from itself in the other placement, in voxels of the larger
/// lattice.
inline double promised(Surface surface) {
    switch (surface) {
        case Surface::cubes:
            return 2;
        case Surface::smooth:
            return 0.1;
        default:
            return 1e-4;
    }
}

/// A scene and its world.
class PlacedScene {
  public:
    explicit PlacedScene(Scene scene) {
        AssetStore meshes;
        scene_ = with_culling(scene, meshes);
        WorldReport report;
        world_ = WorldBuilder(shared_device(), false, meshes).build(scene_, report);
    }

    /// The view from a point `right` and `up` metres to the right of and above the observer.
    Image picture(double right = 0, double up = 0) const {
        Scene scene = scene_;
        scene.observer.position += right * scene.observer.world_from_observer[0] +
                                   up * scene.observer.world_from_observer[1];
        RenderReport report;
        return Renderer(shared_device(), false).new_image(scene, world_, report);
    }

    const Scene& scene() const { return scene_; }

  private:
    Scene scene_;
    BuiltWorld world_;
};

/// The contents of a pixel.
struct Pixel {
    uint32_t object = 0;  ///< 0: none
    glm::dvec3 p{0}, n{0}, light{0};
};

inline Pixel pixel_of(const Image& image, size_t i) {
    const auto vector = [&](const char* x, const char* y, const char* z) {
        return glm::dvec3(image.planes.at(x)[i], image.planes.at(y)[i], image.planes.at(z)[i]);
    };
    return {image.id_planes.at("objectId")[i], vector("P.X", "P.Y", "P.Z"),
            vector("N.X", "N.Y", "N.Z"), vector("R", "G", "B")};
}

/// True if light is equal, except for rounding and for the effect of a hundredth of a degree.
inline bool is_same_light(const glm::dvec3& a, const glm::dvec3& b) {
    for (int i = 0; i < 3; ++i)
        if (!(std::abs(a[i] - b[i]) <= 1e-3 * (1 + std::max(a[i], b[i])))) return false;
    return true;
}

/// The two pictures of a scene.
struct Pictures {
    Image world, instances;
};

/// The scene with its objects in a placement, as far as they can be. `kept` leaves all objects in
/// the world except exact ones, whose voxels depend on the placement.
inline Scene with_placement(Scene scene, Placement placement, bool kept) {
    for (Object& object : scene.objects) {
        const bool stays = kept && scene.models[size_t(object.model)].surface != Surface::exact;
        object.placement =
            placement == Placement::instance && !stays && can_be_instance(scene, object)
                ? Placement::instance
                : Placement::world;
    }
    return scene;
}

/// The scene in local light of its own lights, or of one default light, without samples of emissive
/// objects, without checkers, and without directions of the sky, which the last bits of a position
/// choose.
inline Scene without_samples(Scene scene) {
    scene.render.light = LightMode::local;
    scene.world.ambient = glm::max(scene.world.ambient, glm::vec3(0.1f));
    if (scene.world.sky) scene.world.sky->samples = 0;
    for (Object& object : scene.objects) object.light_samples = 0;
    for (Material& material : scene.materials) material.checker.reset();
    if (scene.lights.empty()) {
        scene.lights.emplace_back();
        scene.lights[0].kind = LightKind::directional;
        scene.lights[0].direction = glm::normalize(glm::dvec3(0.5, -1, 0.7));
        scene.lights[0].intensity = glm::vec3(1);
    }
    return scene;
}

/// Compares a scene's pictures in both placements.
class PlacementPair {
  public:
    /// All surfaces in `scene` must be chosen.
    explicit PlacementPair(const Scene& scene)
        : scene_(scene),
          world_(with_placement(scene, Placement::world, false)),
          pictures_{world_.picture(),
                    PlacedScene(with_placement(scene, Placement::instance, false)).picture()} {}

    const Pictures& pictures() const { return pictures_; }

    Cause cause_of(size_t i) {
        const Pixel a = pixel_of(pictures_.world, i), b = pixel_of(pictures_.instances, i);
        if (a.object == b.object) {
            const double off = a.object ? std::abs(glm::dot(a.p - b.p, a.n)) : 0;
            if (off <= rounding() && (!a.object || glm::dot(a.n, b.n) >= 0.9999))
                return cause_of_light(i, a, b);
            if (off <= promised(surface_of(a.object)) * voxel_of(a.object)) return Cause::lattice;
        } else if (a.object && b.object && glm::length(a.p - b.p) <= rounding()) {
            return Cause::touch;
        }
        if (a.object && is_on_bounds(a.p)) return Cause::cut;
        const bool is_a = distance_of(a) <= distance_of(b);
        const Image& nearer = is_a ? pictures_.world : pictures_.instances;
        const Image& farther = is_a ? pictures_.instances : pictures_.world;
        const Pixel &near = is_a ? a : b, &far = is_a ? b : a;
        if (is_promised(near, farther, i) &&
            (is_promised(far, nearer, i) || is_outline(near, nearer, i)))
            return Cause::lattice;
        return cause_nearby(i, a, b);
    }

  private:
    Cause cause_of_light(size_t i, const Pixel& a, const Pixel& b) {
        if (is_same_light(a.light, b.light)) return Cause::none;
        if (is_alike(without_samples(scene_), false, plain_, i)) return Cause::sampled;
        if (is_alike(scene_, true, kept_, i)) return Cause::others;
        if (is_alike(without_samples(scene_), true, plain_kept_, i)) return Cause::others;
        const Cause kept = cause_nearby(i, a, pixel_of(kept_[1], i));
        const Cause cause = cause_nearby(i, a, b);
        return cause == Cause::unexplained && kept != cause ? Cause::others : cause;
    }

    double rounding() const { return 1e-4 * glm::compMax(scene_.world.voxel_size); }

    Surface surface_of(uint32_t object) const {
        return scene_.models[size_t(scene_.objects[object - 1].model)].surface;
    }

    /// The longest edge of an object's voxels in either placement.
    double voxel_of(uint32_t number) const {
        const Object& object = scene_.objects[number - 1];
        const Model& model = scene_.models[size_t(object.model)];
        double edge = glm::compMax(scene_.world.voxel_size);
        for (int axis = 0; axis < 3; ++axis)
            edge = std::max(edge, model.voxel_size[axis] *
                                      glm::length(glm::dvec3(object.world_from_object[axis])));
        return edge;
    }

    bool is_on_bounds(const glm::dvec3& p) const {
        const Bounds box = lattice_bounds(scene_.world);
        return glm::compMin(glm::min(glm::abs(p - box.min), glm::abs(p - box.max))) <= rounding();
    }

    double distance_of(const Pixel& at) const {
        return at.object ? glm::length(at.p - scene_.observer.position) : INFINITY;
    }

    /// How far an object that a pixel shows may lie elsewhere, in metres: the promise of its
    /// surface, plus a pixel's width.
    double slack_of(const Pixel& at) const {
        const double pitch = 3 * distance_of(at) * std::tan(scene_.observer.display.half_angles.x) /
                             pictures_.world.width;
        return promised(surface_of(at.object)) * voxel_of(at.object) + pitch;
    }

    /// True if a condition holds for a pixel that is at most three pixels from pixel i.
    template <class Condition>
    static bool any_around(const Image& image, size_t i, Condition holds) {
        const int radius = 3, x = int(i) % image.width, y = int(i) / image.width;
        for (int v = std::max(y - radius, 0); v <= std::min(y + radius, image.height - 1); ++v)
            for (int u = std::max(x - radius, 0); u <= std::min(x + radius, image.width - 1); ++u)
                if (holds(pixel_of(image, size_t(v) * size_t(image.width) + size_t(u))))
                    return true;
        return false;
    }

    /// True if the other picture shows the pixel's object at most three pixels away, as close to
    /// the tangent plane there as its surface promises. Exact surfaces have no slack.
    bool is_promised(const Pixel& at, const Image& image, size_t i) const {
        if (!at.object || surface_of(at.object) == Surface::exact) return false;
        return any_around(image, i, [&](const Pixel& other) {
            return other.object == at.object &&
                   std::abs(glm::dot(other.p - at.p, at.n)) <= slack_of(at);
        });
    }

    /// True if an outline of the object that a pixel shows, or a step in its depth, is close to the
    /// pixel in its picture.
    bool is_outline(const Pixel& at, const Image& image, size_t i) const {
        return any_around(image, i, [&](const Pixel& other) {
            return other.object != at.object || distance_of(other) > distance_of(at) + slack_of(at);
        });
    }

    /// True if the pictures of a scene with these placements have the same light at a pixel. The
    /// first call makes the pictures.
    static bool is_alike(const Scene& scene, bool kept, std::vector<Image>& pictures, size_t i) {
        if (pictures.empty())
            for (const Placement placement : {Placement::world, Placement::instance})
                pictures.push_back(PlacedScene(with_placement(scene, placement, kept)).picture());
        return is_same_light(pixel_of(pictures[0], i).light, pixel_of(pictures[1], i).light);
    }

    /// Why a pixel differs when nothing is known to differ about its surface: the world's picture
    /// from points next to the observer changes as much; or it shows another object's surface at
    /// the same point, in which a ray from there may begin.
    Cause cause_nearby(size_t i, const Pixel& a, const Pixel& b) {
        const NearbyViews near = nearby(i, a, b, rounding(), moved_);
        if (near.is_seen && near.is_as_bright) return Cause::edge;
        if (near.is_seen && near.touch) return Cause::touch;
        const NearbyViews far = nearby(i, a, b, 100 * rounding(), moved_far_);
        return far.is_seen && far.is_as_bright ? Cause::far_edge : Cause::unexplained;
    }

    /// What the world's picture shows from points near the observer, within a distance.
    struct NearbyViews {
        bool is_seen = false;       ///< they show the object of the other picture
        bool is_as_bright = false;  ///< the other picture's light lies within the range of theirs
        bool touch = false;         ///< they show another object at the same point
    };
    NearbyViews nearby(size_t i, const Pixel& a, const Pixel& b, double distance,
                       std::vector<Image>& moved) const {
        for (int k = 0; moved.size() < 16; ++k) {
            const double angle = k * 0.7853981634 + 0.2, by = distance * (1 + k / 8) / 2;
            moved.push_back(world_.picture(by * std::cos(angle), by * std::sin(angle)));
        }
        NearbyViews found;
        found.is_seen = a.object == b.object;
        glm::dvec3 low = a.light, high = a.light;
        for (const Image& image : moved) {
            const Pixel other = pixel_of(image, i);
            found.is_seen |= other.object == b.object;
            found.touch |= other.object && other.object != a.object &&
                           glm::length(other.p - a.p) <= 4 * rounding();
            low = glm::min(low, other.light), high = glm::max(high, other.light);
        }
        found.is_as_bright = is_same_light(b.light, glm::clamp(b.light, low, high));
        return found;
    }

    Scene scene_;
    PlacedScene world_;
    Pictures pictures_;
    std::vector<Image> plain_, kept_, plain_kept_, moved_, moved_far_;
};

}  // namespace voxelume
