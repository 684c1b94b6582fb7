// SPDX-License-Identifier: Apache-2.0
// Rendered surfaces against their mesh in double: distances, depths and masks, in voxels.
#include <gtest/gtest.h>

#include "tests/support/accuracy_fixture.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

constexpr int kResolution = 96;
const glm::ivec2 kImage(160, 120);

class Accuracy : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        mesh = wavy_ring(160, 72);
        file = folder / "ring.obj";
        write_obj(file, mesh);
    }

    SurfaceErrors errors_of(const ShownSurface& choice, int lanes = 0) const {
        const Scene scene = mesh_scene(file, mesh, choice, kResolution, kImage);
        RenderReport report;
        const Image image = render(test_device(lanes), scene, report);
        EXPECT_EQ(report.not_finite, 0u);
        return measure_surface(scene, image, oracle::MeshTree(triangles_of(mesh)));
    }

    Mesh mesh;
    std::filesystem::path file;
};

TEST_F(Accuracy, CubesLieWithinHalfAVoxelOfTheMesh) {
    const SurfaceErrors e = errors_of({"cubes", Surface::cubes, VoxelSet::solid});
    EXPECT_GT(e.both, 3000u);
    EXPECT_LT(e.distance_rms, 0.5);
    EXPECT_LT(e.distance_max, std::sqrt(3.0));
}

TEST_F(Accuracy, CubesOfEverythingTouchedHideTheMesh) {
    const SurfaceErrors e = errors_of({"cubes", Surface::cubes, VoxelSet::supercover});
    EXPECT_EQ(e.holes, 0u);
    EXPECT_LT(e.distance_rms, 1);
    EXPECT_LT(e.distance_max, std::sqrt(3.0));
}

TEST_F(Accuracy, SmoothSurfacesLieWithinAHundredthOfAVoxel) {
    const SurfaceErrors e = errors_of({"smooth", Surface::smooth});
    EXPECT_GT(e.both, 3000u);
    EXPECT_LT(e.distance_rms, 0.01);
    EXPECT_LT(e.along_99, 0.06);
    EXPECT_LE(e.mask_differs, 4u);  // 0.02 % of the pixels
}

TEST_F(Accuracy, ExactSurfacesLieWithinAThousandthOfAVoxel) {
    for (const int lanes : {0, 1}) {
        const SurfaceErrors e = errors_of({"exact", Surface::exact}, lanes);
        EXPECT_GT(e.both, 3000u);
        EXPECT_LT(e.distance_rms, 0.001);
        EXPECT_LT(e.distance_max, 0.001);
        EXPECT_LT(e.along_99, 0.005);
        EXPECT_EQ(e.mask_differs_clear, 0u);
    }
}

TEST_F(Accuracy, EverySurfaceKeepsItsOwnInAWorldOfThreeKinds) {
    // The scene has three rings that run through one another. A voxel has one kind, so within two
    // voxels of the places where two rings meet, only the coarser bound holds.
    Scene scene = mesh_scene(file, mesh, {"exact", Surface::exact}, kResolution, kImage);
    const double edge = scene.world.voxel_size.x;
    scene.world.bounds.min -= edge * glm::dvec3(32, 24, 40);
    scene.world.voxels += glm::ivec3(64, 48, 80);
    scene.world.bounds.max = scene.world.bounds.min + glm::dvec3(scene.world.voxels) * edge;
    scene.models.front().extent = scene.world.bounds;
    for (const Surface surface : {Surface::smooth, Surface::cubes}) {
        scene.models.push_back(scene.models.front());
        scene.models.back().surface = surface;
        scene.models.back().set = VoxelSet::solid;
        scene.objects.emplace_back();
        scene.objects.back().model = int(scene.models.size() - 1);
    }
    const glm::dvec3 shifts[] = {{0.7, 0.3, 0}, {29, -8, -12}, {-30, 10, 12}};
    for (size_t i = 0; i < 3; ++i)
        scene.objects[i].world_from_object[3] = glm::dvec4(shifts[i] * edge, 1);
    RenderReport report;
    const Image image = render(test_device(), scene, report);

    const oracle::MeshTree tree(triangles_of(mesh));
    const double bounds[] = {0.001, 0.1, std::sqrt(3.0)};
    size_t pixels[3] = {0, 0, 0};
    for (size_t pixel = 0; pixel < image.planes.at("A").size(); ++pixel) {
        const uint32_t object = image.id_planes.at("objectId")[pixel];
        if (object == 0) continue;
        ASSERT_LE(object, 3u);
        ++pixels[object - 1];
        const glm::dvec3 p(image.planes.at("P.X")[pixel], image.planes.at("P.Y")[pixel],
                           image.planes.at("P.Z")[pixel]);
        double distance[3];
        for (size_t i = 0; i < 3; ++i)
            distance[i] = oracle::distance_to_mesh(tree, p - shifts[i] * edge) / edge;
        const uint32_t own = object - 1;
        const bool meets = distance[(own + 1) % 3] < 2 || distance[(own + 2) % 3] < 2;
        ASSERT_LT(distance[own], meets ? bounds[2] : bounds[own])
            << "object " << object << " pixel " << pixel;
    }
    for (const size_t count : pixels) EXPECT_GT(count, 500u);
}

}  // namespace
}  // namespace voxelume
