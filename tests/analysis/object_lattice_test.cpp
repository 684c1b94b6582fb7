// SPDX-License-Identifier: Apache-2.0
// The lattices on which objects in the world are voxelized: never one that the world undersamples.
#include "runtime/analysis/object_lattice.hpp"

#include <gmock/gmock.h>

#include <glm/geometric.hpp>
#include <set>

#include "runtime/analysis/object_boxes.hpp"
#include "runtime/analysis/scene_choices.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/base/error.hpp"
#include "runtime/grid/world_frame.hpp"
#include "runtime/scene/predicates.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/place/placement_map.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": VOXEL, "bounds": {"min": [-2, -1, -1.5], "max": [2, 1, 1.5]}},
"materials": {"glass": {"refraction": 0.9}},
"models": {"m": {MODEL}},
"objects": [OBJECTS],
"animation": {"frames": 2, "tracks": [TRACKS]},
"observer": {"position": [0, 0, -5], "display": {"shape": "pyramid"}}})";

class LatticeOfObject : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "ring.obj", wavy_ring(24, 12));
    }

    Scene scene_of(const std::string& model, const std::string& objects,
                   const std::string& voxel = "0.05", const std::string& tracks = "") const {
        std::string text = kScene;
        const auto put = [&](const char* word, const std::string& value) {
            text.replace(text.find(word), std::string_view(word).size(), value);
        };
        put("VOXEL", voxel), put("MODEL", model), put("OBJECTS", objects), put("TRACKS", tracks);
        return parse_scene(text, folder / "test.json", {});
    }

    Lattice lattice_of(const Scene& scene) {
        AssetStore meshes;
        return ObjectLattices(scene, meshes).lattice_of(scene.objects[0]);
    }
};

const std::string kRing = R"("mesh": "ring.obj", "surface": "smooth")";
const std::string kBall = R"("shape": "sphere", "radius": 0.5, "surface": "smooth")";

std::string copies(int count, const std::string& keys = "") {
    std::string objects;
    for (int i = 0; i < count; ++i)
        objects += fmt::format(R"({}{{"model": "m", "position": [{}, 0, 0]{}}})", i ? "," : "",
                               0.1 * i + 0.0123, keys);
    return objects;
}

TEST_F(LatticeOfObject, OfASmoothObjectIsTheWorldsHoweverItIsMapped) {
    for (const std::string& model : {kRing, kBall})
        for (const char* keys : {"", R"(, "turn": [10, 20, 30])", R"(, "scale": 0.3)",
                                 R"(, "scale": 4)", R"(, "scale": [1, -2, 0.5])"})
            EXPECT_EQ(lattice_of(scene_of(model, copies(1, keys))), Lattice::world)
                << model << keys;
}

TEST_F(LatticeOfObject, IsTheModelsWhereTheSceneWantsItCoarser) {
    const auto of = [&](const char* size, const char* keys = "") {
        return lattice_of(scene_of(kRing + size, copies(1, keys)));
    };
    EXPECT_EQ(of(R"(, "voxel_size": 0.1)"), Lattice::model);
    EXPECT_EQ(of(R"(, "resolution": 5)"), Lattice::model);
    EXPECT_EQ(of(R"(, "voxel_size": 0.05)"), Lattice::world);
    EXPECT_EQ(of(R"(, "voxel_size": 0.01)"), Lattice::world);
    EXPECT_EQ(of(R"(, "resolution": 500)"), Lattice::world);
    EXPECT_EQ(of(R"(, "voxel_size": 0.1)", R"(, "scale": 0.4)"), Lattice::world);
    EXPECT_EQ(of(R"(, "voxel_size": 0.1)", R"(, "scale": [1, 1, 0.4])"), Lattice::world);
    EXPECT_EQ(of(R"(, "voxel_size": 0.04)", R"(, "scale": 2)"), Lattice::model);
}

TEST_F(LatticeOfObject, IsTheModelsOwnWhereItsNodesAreTheWorlds) {
    const auto of = [&](const char* keys, const std::string& model = kRing) {
        return lattice_of(scene_of(model, fmt::format(R"({{"model": "m"{}}})", keys)));
    };
    EXPECT_EQ(of(""), Lattice::model);
    EXPECT_EQ(of(R"(, "position": [0.35, -0.1, 0.2])"), Lattice::model);
    EXPECT_EQ(of(R"(, "turn": [90, 0, -180], "scale": [1, -1, 1])"), Lattice::model);
    EXPECT_EQ(of("", kBall), Lattice::model);
    EXPECT_EQ(of(R"(, "position": [0.35, -0.125, 0.2])"), Lattice::world);
    EXPECT_EQ(of(R"(, "turn": [90, 0, 45])"), Lattice::world);
    EXPECT_EQ(of(R"(, "scale": 2)"), Lattice::world);
    EXPECT_EQ(of("", kRing + R"(, "resolution": 20)"), Lattice::world) << "a lattice of its own";
}

TEST_F(LatticeOfObject, OfCubesIsTheModelsAndOfExactSurfacesTheWorlds) {
    const std::string ring = R"("mesh": "ring.obj", "voxel_size": 0.02, "surface": )";
    EXPECT_EQ(lattice_of(scene_of(ring + R"("cubes")", copies(1))), Lattice::model);
    EXPECT_EQ(lattice_of(scene_of(ring + R"("exact")", copies(1))), Lattice::world);
}

TEST_F(LatticeOfObject, IsSharedByManyCopiesAndByAMovingObject) {
    EXPECT_EQ(lattice_of(scene_of(kRing, copies(2))), Lattice::world);
    EXPECT_EQ(lattice_of(scene_of(kRing, copies(40))), Lattice::shared);
    EXPECT_EQ(lattice_of(scene_of(
                  kRing, copies(40, R"(, "placement": "instance")") + R"(, {"model": "m"})")),
              Lattice::world)
        << "instances aren't copies in the world";
    const std::string track =
        R"({"target": "objects[0].position", "keys": [{"frame": 1, "value": [0.0123, 0, 0]}]})";
    EXPECT_EQ(lattice_of(scene_of(kRing, copies(1, R"(, "placement": "world")"), "0.05", track)),
              Lattice::shared);
    EXPECT_EQ(lattice_of(scene_of(kRing, copies(40, R"(, "scale": [1, 1, 1.1])"))), Lattice::world)
        << "distances change under such a map";
    EXPECT_EQ(lattice_of(scene_of(kRing, copies(40), "[0.05, 0.05, 0.04]")), Lattice::world);
}

TEST_F(LatticeOfObject, SharedVoxelsAreAtMostAFifthLargerThanTheWorldsAndNeverSmaller) {
    AssetStore meshes;
    std::set<double> edges;
    for (double scale = 0.1; scale < 10; scale *= 1.037) {
        const Scene scene = scene_of(
            kRing, copies(20, fmt::format(R"(, "turn": [10, 20, 30], "scale": {})", scale)));
        ObjectLattices lattices(scene, meshes);
        const GridFrame frame = lattices.own_frame(scene.objects[0]);
        const double ratio = voxels_per_world_voxel(frame, world_frame(scene.world),
                                                    scene.objects[0].world_from_object);
        EXPECT_LE(ratio, 1 + 1e-9) << scale;
        EXPECT_GE(ratio, 0.8) << scale;
        edges.insert(frame.voxel_edge.x);
    }
    EXPECT_LE(edges.size(), 28u) << "objects of all scales share few grids";
}

TEST_F(LatticeOfObject, InTheWorldIsAPartOfItsLatticeWithAllDistancesOfTheSurface) {
    AssetStore meshes;
    for (const std::string& model : {kRing, kBall}) {
        const Scene scene =
            scene_of(model, R"({"model": "m", "position": [1.6, 0.2, 0], "turn": [30, 10, 5]})");
        const VoxelBox box = object_boxes(scene, meshes)[0];
        const GridFrame world = world_frame(scene.world);
        const ObjectLattice of = ObjectLattices(scene, meshes).of(scene.objects[0], box);
        EXPECT_EQ(of.world_from_frame, glm::dmat4(1));
        EXPECT_EQ(of.frame_from_object, scene.objects[0].world_from_object);
        EXPECT_EQ(of.frame.voxel_edge, world.voxel_edge);
        const glm::dvec3 first = (of.frame.origin - world.origin) / world.voxel_edge / 16.0;
        EXPECT_LT(glm::distance(first, glm::round(first)), 1e-9) << "whole bricks";
        const glm::dvec3 low = 16.0 * first, high = low + glm::dvec3(of.frame.size);
        for (int axis = 0; axis < 3; ++axis) {
            EXPECT_LE(low[axis], box.low[axis] - 3);
            EXPECT_GE(high[axis], box.high[axis] + 3);
        }
        EXPECT_LE(high.x, world.size.x + 32) << "no larger than the world needs";
    }
}

class FieldFiles : public LatticeOfObject {
  protected:
    /// A scene of a file of distances with voxels of 0.02.
    Scene scene_of_field(const std::string& keys, const char* voxel) {
        const std::filesystem::path file = folder / "ring.vxm";
        if (!std::filesystem::exists(file)) {
            const Mesh mesh = wavy_ring(24, 12);
            const BrickGrid grid = voxelize_mesh(shared_device(), mesh, glm::dmat4(1),
                                                 frame_around(mesh, glm::dvec3(0.02)), {});
            VoxelExport(grid, mesh, Surface::smooth, VoxelSet::supercover).write_model(file);
        }
        return scene_of(R"("voxels": "ring.vxm", "surface": "smooth")",
                        R"({"name": "ring", "model": "m")" + keys + "}", voxel);
    }
    std::string refusal_of(const Scene& scene) {
        AssetStore meshes;
        try {
            const std::vector<VoxelBox> boxes = object_boxes(scene, meshes);
            ObjectLattices(scene, meshes).of(scene.objects[0], boxes[0]);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::scene);
            return error.what();
        }
        return "";
    }
    bool is_instance(Scene scene) {
        AssetStore meshes;
        make_choices(scene, meshes);
        return is_instanced(scene, scene.objects[0]);
    }
};

TEST_F(FieldFiles, ThatAreFinerThanTheWorldBecomeInstances) {
    EXPECT_FALSE(is_instance(scene_of_field("", "0.02")));
    EXPECT_FALSE(is_instance(scene_of_field("", "0.028")));
    EXPECT_TRUE(is_instance(scene_of_field("", "0.03")));
    EXPECT_TRUE(is_instance(scene_of_field(R"(, "scale": 0.5)", "0.02")));
    EXPECT_FALSE(is_instance(scene_of_field(R"(, "scale": 2)", "0.03")));
    EXPECT_FALSE(is_instance(scene_of_field(R"(, "placement": "world")", "0.03")));
    EXPECT_TRUE(is_instance(scene_of_field(R"(, "material": "glass")", "0.03")));
}

TEST_F(FieldFiles, ThatMustBeInTheWorldAreRefusedThereWithWhatToDo) {
    EXPECT_EQ(refusal_of(scene_of_field("", "0.028")), "");
    for (const char* keys : {R"(, "placement": "world")", R"(, "material": "glass")"})
        EXPECT_THAT(refusal_of(scene_of_field(keys, "0.04")),
                    testing::AllOf(HasSubstr("test.json:5:"), HasSubstr("\"ring\""),
                                   HasSubstr("2 times as fine as the world's"),
                                   HasSubstr("\"placement\": \"instance\"")));
}

}  // namespace
}  // namespace voxelume
