// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/bench/bench_scene.hpp"

#include <array>
#include <cmath>
#include <glm/geometric.hpp>
#include <glm/trigonometric.hpp>
#include <utility>

#include "runtime/scene/parts/scene_affine.hpp"

namespace voxelume {
namespace {

std::array<BenchSolid, 3> make_solids() {
    Solid sphere, torus, box;
    sphere.radius = 0.47;
    torus.kind = SolidKind::torus;
    torus.radius = 0.3;
    torus.tube = 0.19;
    box.kind = SolidKind::box;
    box.size = {0.67, 0.41, 0.53};
    const auto placed = [](glm::dvec3 position, glm::dvec3 turn) {
        return affine_from_factors(position, turn, glm::dvec3(1));
    };
    // The torus is turned so that it shows its hole: no ray passes its tube twice, so behind its
    // silhouette there is only air.
    return {BenchSolid{"sphere", "radius 0.47 m", sphere, sphere.radius,
                       placed({0.0123, -0.0071, 0.0052}, {0, 0, 0})},
            BenchSolid{"torus", "radius 0.3 m, tube 0.19 m, turned", torus, torus.tube,
                       placed({-0.0082, 0.0117, 0.0034}, {30, 40, 15})},
            BenchSolid{"box", "0.67 x 0.41 x 0.53 m, turned", box, 0,
                       placed({0.0041, 0.0093, -0.0126}, {25, -35, 20})}};
}

Observer observer_of(glm::ivec2 size) {
    Observer observer;
    observer.position = 2.4 * glm::normalize(glm::dvec3(0.5, 0.35, 1));
    const glm::dvec3 z = -glm::normalize(observer.position);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
    observer.world_from_observer = glm::dmat3(x, glm::cross(z, x), z);
    const glm::dvec2 sides(size);
    const double half = std::tan(glm::radians(14.0)) / std::min(sides.x, sides.y);
    observer.display.half_angles = {std::atan(half * sides.x), std::atan(half * sides.y)};
    observer.display.far = 100;
    return observer;
}

}  // namespace

std::span<const BenchSolid> bench_solids() {
    static const std::array<BenchSolid, 3> solids = make_solids();
    return solids;
}

Scene empty_bench_scene(int resolution, glm::ivec2 size) {
    constexpr double kHalf = 0.55;  // metres from the origin within which every subject stays
    constexpr int kMargin = 8;      // in voxels of air
    Scene scene;
    const double edge = 1.0 / resolution;
    const int half = int(std::ceil(kHalf * resolution)) + kMargin;
    scene.world.voxel_size = glm::dvec3(edge);
    scene.world.voxels = glm::ivec3(2 * half);
    scene.world.bounds = {glm::dvec3(-half * edge), glm::dvec3(half * edge)};
    scene.materials.emplace_back();
    scene.observer = observer_of(size);
    scene.render.size = size;
    return scene;
}

void add_bench_object(Scene& scene, Model model, Surface surface, int resolution,
                      const glm::dmat4& placement) {
    const double scale = glm::length(glm::dvec3(placement[0]));
    model.voxel_size = glm::dvec3(1 / (resolution * scale));
    model.surface = surface;
    model.extent = {glm::dvec3(-2 / scale), glm::dvec3(2 / scale)};
    Object object;
    object.name = model.name;
    object.world_from_object = placement;
    scene.models.push_back(std::move(model));
    scene.objects.push_back(std::move(object));
}

Scene bench_scene(const BenchSolid& solid, Surface surface, int resolution, glm::ivec2 size) {
    Scene scene = empty_bench_scene(resolution, size);
    Model model;
    model.name = solid.name;
    model.solid = solid.solid;
    add_bench_object(scene, std::move(model), surface, resolution, solid.world_from_solid);
    return scene;
}

glm::dvec3 sight_direction(const Scene& scene, double column, double row) {
    const glm::dvec2 half = glm::tan(scene.observer.display.half_angles);
    const double u = 2 * column / scene.render.size.x - 1;
    const double v = 2 * row / scene.render.size.y - 1;
    return glm::normalize(scene.observer.world_from_observer *
                          glm::dvec3(-u * half.x, -v * half.y, 1));
}

}  // namespace voxelume
