// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_shadow.hpp"

#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>

#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

constexpr double kGround = -0.62;    // metres along Y, below every subject's coarsest voxels
constexpr double kGroundHalf = 1.3;  // metres, holds all shadows

glm::dvec3 towards_sun() {
    return glm::normalize(glm::dvec3(-0.7, 1, -0.25));
}

void add_ground(Scene& scene) {
    constexpr double kThickness = 0.05;  // metres
    Model model;
    model.name = "ground";
    Solid box;
    box.kind = SolidKind::box;
    box.size = {2 * kGroundHalf, kThickness, 2 * kGroundHalf};
    model.solid = box;
    model.surface = Surface::exact;
    model.voxel_size = glm::dvec3(0.1);
    model.extent = {-box.size, box.size};
    Object ground;
    ground.name = model.name;
    ground.model = int(scene.models.size());
    ground.placement = Placement::instance;
    ground.world_from_object =
        affine_from_factors({0, kGround - kThickness / 2, 0}, {0, 0, 0}, glm::dvec3(1));
    scene.models.push_back(std::move(model));
    scene.objects.push_back(std::move(ground));
}

void look_down(Scene& scene) {
    const glm::dvec3 target(0.3, kGround, 0.1);
    scene.observer.position = target + 3.2 * glm::normalize(glm::dvec3(0.35, 1, 0.3));
    const glm::dvec3 z = glm::normalize(target - scene.observer.position);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 0, 1), z));
    scene.observer.world_from_observer = glm::dmat3(x, glm::cross(z, x), z);
    const glm::dvec2 sides(scene.render.size);
    const double half = std::tan(glm::radians(18.0)) / std::min(sides.x, sides.y);
    scene.observer.display.half_angles = {std::atan(half * sides.x), std::atan(half * sides.y)};
}

/// Extends the world's bounds on the subject's lattice, so that the ground fits.
void make_room(World& world) {
    constexpr int kMargin = 2;  // voxels
    const double edge = world.voxel_size.x;
    const int side = int(std::ceil(kGroundHalf / edge)) + kMargin;
    const glm::ivec3 half(side, std::max(int(std::ceil(0.7 / edge)) + kMargin, world.voxels.y / 2),
                          side);
    world.voxels = 2 * half;
    world.bounds = {-edge * glm::dvec3(half), edge * glm::dvec3(half)};
}

}  // namespace

Scene shadow_scene(const BenchSubject& subject, Surface surface, int resolution, glm::ivec2 size) {
    Scene scene = subject.scene(surface, resolution, size);
    make_room(scene.world);
    add_ground(scene);
    look_down(scene);
    Light sun;
    sun.name = "sun";
    sun.kind = LightKind::directional;
    sun.direction = -towards_sun();
    scene.lights = {sun};
    return scene;
}

ShadowTruth shadow_truth(const BenchSubject& subject, glm::ivec2 size) {
    const Scene scene = shadow_scene(subject, Surface::exact, 8, size);
    const glm::dvec3 eye = scene.observer.position, sun = towards_sun();
    const auto ground_at = [&](const glm::dvec3& direction) {
        return eye + (kGround - eye.y) / direction.y * direction;
    };
    const auto is_dark = [&](const glm::dvec3& p) { return subject.first_hit(p, sun).has_value(); };
    const auto side_at = [&](const glm::dvec3& direction) {
        const glm::dvec3 p = ground_at(direction);
        if (direction.y >= 0 || std::max(std::abs(p.x), std::abs(p.z)) > kGroundHalf ||
            subject.first_hit(eye, direction))
            return PixelSide::unknown;
        return is_dark(p) ? PixelSide::inside : PixelSide::outside;
    };
    ShadowTruth truth;
    truth.size = size;
    truth.sides.resize(size_t(size.x) * size_t(size.y));
    for_rows(size.y, [&](int row) {
        for (int column = 0; column < size.x; ++column)
            truth.sides[size_t(row) * size_t(size.x) + size_t(column)] =
                side_at(sight_direction(scene, column + 0.5, row + 0.5));
    });
    truth.edge = contour_of(size, truth.sides, [&](const glm::dvec2& pixel) {
        return is_dark(ground_at(sight_direction(scene, pixel.x, pixel.y)));
    });
    return truth;
}

ShadowErrors measure_shadow(const ShadowTruth& truth, const Image& image) {
    constexpr uint32_t kGroundId = 2;  // the second object
    const Plane<uint32_t>& objects = image.id_planes.at("objectId");
    const Plane<float>& light = image.planes.at("G");
    ContourError error(truth.edge);
    for (size_t pixel = 0; pixel < truth.sides.size(); ++pixel) {
        if (truth.sides[pixel] == PixelSide::unknown || objects[pixel] != kGroundId) continue;
        const bool is_dark = light[pixel] == 0;
        if (is_dark == (truth.sides[pixel] == PixelSide::inside)) continue;
        const size_t column = pixel % size_t(truth.size.x), row = pixel / size_t(truth.size.x);
        error.add({double(column) + 0.5, double(row) + 0.5});
    }
    return {error.mean(), error.max()};
}

}  // namespace voxelume
