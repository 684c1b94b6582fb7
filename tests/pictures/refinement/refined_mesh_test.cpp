// SPDX-License-Identifier: Apache-2.0
// Meshes of round shapes with the surface that `auto` chooses, in worlds that get finer.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <glm/geometric.hpp>
#include <optional>
#include <string>
#include <vector>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/scene/parts/surface.hpp"
#include "tests/oracles/analytic_solids.hpp"
#include "tests/pictures/refinement/refined_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

/// A ball or a ring whose corners lie on a shape.
struct MeshOfShape {
    std::string name;
    std::string shape;  ///< keys of a model
    Mesh mesh;
    bool is_thin = false;  ///< in few voxels, where `auto` makes it exact
};

MeshOfShape meshed_ellipsoid(const char* name, const glm::dvec3& radii, int columns, int rows) {
    MeshOfShape made{
        name,
        fmt::format(R"("shape": "ellipsoid", "radii": [{}, {}, {}])", radii.x, radii.y, radii.z),
        ball(glm::dvec3(0), 1, columns, rows)};
    for (glm::vec3& p : made.mesh.positions) p = glm::vec3(glm::dvec3(p) * radii);
    return made;
}

MeshOfShape meshed_ring(const char* name, double radius, double tube, int around, int across) {
    return {name, fmt::format(R"("shape": "torus", "radius": {}, "tube": {})", radius, tube),
            closed_grid(around, across, [&](double u, double v) {
                const double out = radius + tube * std::cos(v);
                return glm::dvec3(out * std::cos(u), tube * std::sin(v), -out * std::sin(u));
            })};
}

/// An image's errors against the facets, and against the shape that they approximate.
struct RefinedMeshErrors {
    Surface surface = Surface::smooth;
    double to_facets = 0, to_shape = 0;  ///< metres, RMS
    double normal = 0;                   ///< degrees to the shape's normals, RMS
    size_t mask = 0;                     ///< pixels whose ray meets facets, or none, wrongly
};

/// Measures what an image shows against the shape: `truth` is the same scene with it.
void measure_shape(const Scene& truth, const Image& image, RefinedMeshErrors& errors) {
    const oracle::AnalyticSolid solid(*truth.models[0].solid, truth.objects[0].world_from_object);
    const auto vector = [&](const std::string& name, size_t pixel) {
        return glm::dvec3(image.planes.at(name + ".X")[pixel], image.planes.at(name + ".Y")[pixel],
                          image.planes.at(name + ".Z")[pixel]);
    };
    double distances = 0, angles = 0;
    size_t count = 0;
    for (size_t pixel = 0; pixel < size_t(image.width) * size_t(image.height); ++pixel) {
        if (image.id_planes.at("objectId")[pixel] == 0) continue;
        const glm::dvec3 p = vector("P", pixel), n = vector("N", pixel);
        const auto distance = double(solid.distance(oracle::Vector(p)));
        glm::dvec3 slope(0);
        for (int axis = 0; axis < 3; ++axis) {
            glm::dvec3 step(0);
            step[axis] = 1e-6;
            slope[axis] = double(solid.distance(oracle::Vector(p + step)) -
                                 solid.distance(oracle::Vector(p - step)));
        }
        const double angle = std::atan2(glm::length(glm::cross(n, slope)), glm::dot(n, slope));
        distances += distance * distance, angles += angle * angle;
        ++count;
    }
    ASSERT_GT(count, 500u);
    errors.to_shape = std::sqrt(distances / double(count));
    errors.normal = glm::degrees(std::sqrt(angles / double(count)));
}

class RefinedMesh : public FileTest {
  protected:
    RefinedMeshErrors errors_in(const MeshOfShape& made, double voxel, const char* surface) {
        write_obj(folder / "m.obj", made.mesh);
        Scene scene = refined_scene(fmt::format(R"("mesh": "m.obj", "surface": "{}")", surface),
                                    kRefinedPlace, voxel, kRefinedSize, folder);
        std::vector<oracle::Triangle> triangles = triangles_of(made.mesh);
        for (oracle::Triangle& triangle : triangles)
            for (glm::dvec3& p : triangle)
                p = glm::dvec3(scene.objects[0].world_from_object * glm::dvec4(p, 1));
        const Image image = refined_image(scene);
        const SurfaceErrors facets =
            measure_surface(scene, image, oracle::MeshTree(std::move(triangles)));
        AssetStore meshes;
        make_choices(scene, meshes);
        RefinedMeshErrors errors{scene.models[0].surface, facets.distance_rms * voxel, 0, 0,
                                 facets.mask_differs};
        measure_shape(refined_scene(made.shape, kRefinedPlace, voxel), image, errors);
        return errors;
    }
};

std::vector<MeshOfShape> meshes_of_shapes() {
    std::vector<MeshOfShape> all = {meshed_ring("ring", .18, .07, 192, 96),
                                    meshed_ring("thin ring", .18, .012, 384, 48)};
    all.back().is_thin = true;
    if (is_exhaustive()) {
        all.push_back(meshed_ellipsoid("ball", {.16, .16, .16}, 192, 96));
        all.push_back(meshed_ellipsoid("lens", {.2, .03, .17}, 384, 192));
        all.back().is_thin = true;
    }
    return all;
}

std::string refined_words(const MeshOfShape& made, int voxels, const RefinedMeshErrors& errors) {
    return fmt::format(
        "{} in {} voxels, {}: {:.2e} m from its facets, {:.2e} m from the shape, normals {:.3f} "
        "degrees, {} pixels",
        made.name, voxels, kind_of(errors.surface).name, errors.to_facets, errors.to_shape,
        errors.normal, errors.mask);
}

/// Float level, metres.
constexpr double kFloatError = 1e-7;
/// The maximum error of the first field after `exact`, in voxels.
constexpr double kFirstField = 0.005;

/// The facets are what the file says. The first field is farther from them than `exact` was.
void expect_no_farther_from_facets(const RefinedMeshErrors& now, const RefinedMeshErrors& before,
                                   double voxel, const std::string& what) {
    if (now.surface == Surface::exact) {
        EXPECT_EQ(before.surface, Surface::exact) << what;
        EXPECT_LT(now.to_facets, kFloatError) << what;
        EXPECT_EQ(now.mask, 0u) << what;
    } else if (before.surface == Surface::exact) {
        EXPECT_LT(now.to_facets, kFirstField * voxel) << what;
        EXPECT_LE(now.mask, 8u) << what;
    } else {
        EXPECT_LE(now.to_facets, 1.05 * before.to_facets) << what;
        EXPECT_LE(double(now.mask), 1.05 * double(before.mask) + 2) << what;
    }
}

/// The shape is what somebody modelled, and `facets` the errors of the mesh itself. A field hides
/// facets until its voxels are finer than they are, so its normals come back to theirs.
void expect_no_farther_from_shape(const RefinedMeshErrors& now, const RefinedMeshErrors& before,
                                  const RefinedMeshErrors& facets, double voxel,
                                  const std::string& what) {
    const double slack = before.surface == now.surface ? 0 : kFirstField * voxel;
    const double maximum = std::max(before.to_shape, facets.to_shape);
    EXPECT_LE(now.to_shape, std::max(1.05 * maximum, slack)) << what;
    EXPECT_LE(now.normal, 1.05 * std::max(before.normal, facets.normal)) << what;
}

TEST_F(RefinedMesh, OfAutoIsNoWorseInAFinerWorld) {
    for (const MeshOfShape& made : meshes_of_shapes()) {
        const double longest = longest_side(bounds_of(made.mesh));
        const RefinedMeshErrors facets = errors_in(made, longest / 64, "exact");
        std::optional<RefinedMeshErrors> before;
        for (const int voxels : doubled_up_to(16, 128, 512)) {
            const double voxel = longest / voxels;
            const RefinedMeshErrors now = errors_in(made, voxel, "auto");
            const std::string what = refined_words(made, voxels, now);
            fmt::print("{}\n", what);
            EXPECT_EQ(now.surface == Surface::exact, made.is_thin && voxels <= 64) << what;
            if (before) {
                expect_no_farther_from_facets(now, *before, voxel, what);
                expect_no_farther_from_shape(now, *before, facets, voxel, what);
            }
            before = now;
        }
    }
}

}  // namespace
}  // namespace voxelume
