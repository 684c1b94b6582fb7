// SPDX-License-Identifier: Apache-2.0
// The distance of a rendered surface from its mesh: the scene, and the measurements on its image.
#pragma once

#include <algorithm>
#include <cmath>
#include <filesystem>
#include <numbers>
#include <vector>

#include "runtime/geometry/mesh.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene/parts/bounds.hpp"
#include "tests/oracles/mesh/mesh_distance.hpp"
#include "tests/oracles/mesh/mesh_ray.hpp"

namespace voxelume {

inline Bounds bounds_of(const Mesh& mesh) {
    Bounds bounds{glm::dvec3(INFINITY), glm::dvec3(-INFINITY)};
    for (const glm::uvec3& triangle : mesh.triangles) {
        for (int corner = 0; corner < 3; ++corner) {
            const glm::dvec3 p(mesh.positions[triangle[corner]]);
            bounds.min = glm::min(bounds.min, p);
            bounds.max = glm::max(bounds.max, p);
        }
    }
    return bounds;
}

inline std::vector<oracle::Triangle> triangles_of(const Mesh& mesh) {
    std::vector<oracle::Triangle> triangles;
    triangles.reserve(mesh.triangles.size());
    for (const glm::uvec3& t : mesh.triangles)
        triangles.push_back({glm::dvec3(mesh.positions[t.x]), glm::dvec3(mesh.positions[t.y]),
                             glm::dvec3(mesh.positions[t.z])});
    return triangles;
}

/// An observer at `position` looking at `target` through a pyramid with square pixels.
inline Observer observer_at(const glm::dvec3& position, const glm::dvec3& target,
                            double vertical_angle, const glm::ivec2& size) {
    Observer observer;
    observer.position = position;
    const glm::dvec3 z = glm::normalize(target - position);
    const glm::dvec3 x = glm::normalize(glm::cross(glm::dvec3(0, 1, 0), z));
    observer.world_from_observer = glm::dmat3(x, glm::cross(z, x), z);
    const double half = vertical_angle / 2;
    observer.display.half_angles = {std::atan(std::tan(half) * size.x / size.y), half};
    observer.display.far = 1e6;
    return observer;
}

/// The surface and the voxel set with which a mesh is shown.
struct ShownSurface {
    const char* name;
    Surface surface;
    VoxelSet set = VoxelSet::supercover;  ///< for cubes
};

/// A scene of the mesh in `file` at its own position, with `resolution` voxels along its longest
/// side, and an observer 1.8 longest sides from its centre. There are no lights.
inline Scene mesh_scene(const std::filesystem::path& file, const Mesh& mesh,
                        const ShownSurface& choice, int resolution, const glm::ivec2& size) {
    constexpr int kMargin = 8;  // voxels of air around the mesh
    const Bounds bounds = bounds_of(mesh);
    const double longest = longest_side(bounds), edge = longest / resolution;
    Scene scene;
    scene.world.voxel_size = glm::dvec3(edge);
    scene.world.bounds.min = bounds.min - edge * kMargin;
    scene.world.voxels =
        glm::ivec3(glm::ceil((bounds.max - bounds.min) / edge - 1e-6)) + 2 * kMargin;
    scene.world.bounds.max =
        scene.world.bounds.min + glm::dvec3(scene.world.voxels) * scene.world.voxel_size;
    scene.materials.emplace_back();
    Model model;
    model.mesh = file;
    model.resolution = resolution;
    model.surface = choice.surface;
    model.set = choice.set;
    model.extent = scene.world.bounds;
    scene.models.push_back(model);
    scene.objects.emplace_back();
    const glm::dvec3 center = (bounds.min + bounds.max) / 2.0;
    const glm::dvec3 eye = center + longest * 1.8 * glm::normalize(glm::dvec3(0.5, 0.35, 1));
    scene.observer = observer_at(eye, center, 40 * std::numbers::pi / 180, size);
    scene.render.size = size;
    return scene;
}

/// The direction of the ideal sight ray through a pixel's centre.
inline glm::dvec3 pixel_direction(const Scene& scene, int column, int row) {
    const glm::dvec2 half = glm::tan(scene.observer.display.half_angles);
    const double u = 2 * (column + 0.5) / scene.render.size.x - 1;
    const double v = 2 * (row + 0.5) / scene.render.size.y - 1;
    return glm::normalize(scene.observer.world_from_observer *
                          glm::dvec3(-u * half.x, -v * half.y, 1));
}

/// Errors of an image of a mesh, in voxels.
struct SurfaceErrors {
    size_t pixels = 0, hits = 0, both = 0;      ///< both: hit in the image and by the ideal ray
    double distance_rms = 0, distance_max = 0;  ///< of P to the mesh
    double along_median = 0, along_99 = 0, along_max = 0;  ///< between the hits along the ray
    size_t mask_differs = 0;                               ///< pixels hit by only one of the two
    size_t mask_differs_clear = 0;  ///< of these, farther than 0.001 voxel from a silhouette edge
    size_t holes = 0;               ///< of these, hit by the ideal ray only

    double mask_share() const { return double(mask_differs) / double(std::max<size_t>(pixels, 1)); }
};

/// The value below which the fraction `share` of the values lies; sorts them.
inline double quantile(std::vector<double>& values, double share) {
    if (values.empty()) return 0;
    std::sort(values.begin(), values.end());
    return values[std::min(values.size() - 1, size_t(share * double(values.size())))];
}

/// Compares an image with the mesh itself.
inline SurfaceErrors measure_surface(const Scene& scene, const Image& image,
                                     const oracle::MeshTree& tree) {
    constexpr double kClear = 0.001;
    const double edge = scene.world.voxel_size.x;
    const glm::dvec3 eye = scene.observer.position;
    const std::vector<oracle::Edge> silhouette = oracle::silhouette_edges(tree.triangles(), eye);
    const Plane<float>&px = image.planes.at("P.X"), &py = image.planes.at("P.Y"),
          &pz = image.planes.at("P.Z"), &alpha = image.planes.at("A");
    SurfaceErrors errors;
    std::vector<double> along;
    double squares = 0;
    for (int row = 0; row < image.height; ++row) {
        for (int column = 0; column < image.width; ++column) {
            const size_t pixel = size_t(row) * size_t(image.width) + size_t(column);
            const glm::dvec3 direction = pixel_direction(scene, column, row);
            const std::optional<double> ideal = oracle::first_hit(tree, eye, direction);
            const bool hit = alpha[pixel] > 0;
            const glm::dvec3 p(px[pixel], py[pixel], pz[pixel]);
            ++errors.pixels;
            if (hit) {
                ++errors.hits;
                const double distance = oracle::distance_to_mesh(tree, p) / edge;
                squares += distance * distance;
                errors.distance_max = std::max(errors.distance_max, distance);
            }
            if (hit && ideal)
                along.push_back(std::abs(glm::dot(p - eye, direction) - *ideal) / edge);
            if (hit == ideal.has_value()) continue;
            ++errors.mask_differs;
            if (ideal) ++errors.holes;
            if (oracle::distance_to_edges(silhouette, eye, direction) > kClear * edge)
                ++errors.mask_differs_clear;
        }
    }
    errors.distance_rms = std::sqrt(squares / double(std::max<size_t>(errors.hits, 1)));
    errors.both = along.size();
    errors.along_max = quantile(along, 1);
    errors.along_99 = quantile(along, 0.99);
    errors.along_median = quantile(along, 0.5);
    return errors;
}

}  // namespace voxelume
