// Rendered surfaces against their mesh in double: distances, depths and masks, in voxels.
#include <gtest/gtest.h>

#include "tests/accuracy_fixture.hpp"
#include "tests/file_fixture.hpp"
#include "tests/test_device.hpp"
#include "tests/test_meshes.hpp"

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

    SurfaceErrors errors_of(const SurfaceChoice& choice, int lanes = 0) const {
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
    // Three rings, one behind the other and overlapping on the screen.
    Scene scene = mesh_scene(file, mesh, {"exact", Surface::exact}, kResolution, kImage);
    const double edge = scene.world.voxel_size.x;
    scene.world.bounds.min.z -= 40 * edge;
    scene.world.voxels += glm::ivec3(24, 12, 80);
    scene.world.bounds.max = scene.world.bounds.min + glm::dvec3(scene.world.voxels) * edge;
    scene.models.front().reach = scene.world.bounds;
    for (const Surface surface : {Surface::smooth, Surface::cubes}) {
        scene.models.push_back(scene.models.front());
        scene.models.back().surface = surface;
        scene.models.back().set = VoxelSet::solid;
        scene.objects.emplace_back();
        scene.objects.back().model = int(scene.models.size() - 1);
    }
    const glm::dvec3 shifts[] = {{0.7, 0.3, 0}, {17, 9, 36}, {5, -2, -31}};
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
        const double distance = oracle::distance_to_mesh(tree, p - shifts[object - 1] * edge) / edge;
        ASSERT_LT(distance, bounds[object - 1]) << "object " << object << " pixel " << pixel;
    }
    for (const size_t count : pixels) EXPECT_GT(count, 500u);
}

}  // namespace
}  // namespace voxelume
