// SPDX-License-Identifier: Apache-2.0
// Models whose voxels come from files.
#include "runtime/assets/voxel_model_file.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

#include "runtime/assets/asset_store.hpp"
#include "runtime/assets/model_frame.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/base/error.hpp"
#include "runtime/io/vdb/vdb.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kColors[] = {"R", "G", "B"};
constexpr const char* kObj =
    "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nv 0 0 0.5\nusemtl a\nf 1 3 2\nf 1 2 4\nusemtl b\nf 2 3 4\nf 3 1 "
    "4\n";

class VoxelModels : public FileTest {
  protected:
    Image rendered(const std::string& model, const std::string& materials,
                   const std::string& more = "") const {
        const std::string text = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-0.5, -0.5, -0.5], "max": [1.5, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.1, 0.2, 0.3]},
"materials": {"m": {}, "n": {"color": [0.2, 0.9, 0.3]})" +
                                 materials + R"(},
"models": {"thing": )" + model + R"(},
"objects": [{"model": "thing", "material": "m", "turn": [0, 0, 0]})" +
                                 more + R"(],
"lights": [{"type": "directional", "direction": [0.3, -1, 0.4]}],
"observer": {"position": [1.2, 1, -2], "look_at": [0.3, 0.2, 0.2],
             "display": {"shape": "pyramid", "angle": 30}},
"render": {"size": [48, 36]}})";
        RenderReport report;
        return render(test_device(), parse_scene(text, folder / "s.json", {}), report);
    }

    void voxelize_to(const std::string& name, Surface surface,
                     CubeNormals normals = CubeNormals::faces) const {
        put_bytes(folder / "m.obj", kObj);
        const Device device = test_device();
        AssetStore meshes;
        const Mesh& mesh = meshes.mesh(folder / "m.obj");
        const MeshSummary summary = summary_of(mesh);
        Model model;
        model.voxel_size = glm::dvec3(0.05);
        model.surface = surface;
        model.normals = normals;
        const BrickGrid grid = Voxelizer(device).voxelize(
            mesh, glm::dmat4(1), model_frame(model, &summary), options_of(model));
        const VoxelExport exported(grid, mesh, surface, VoxelSet::supercover);
        exported.write_model(folder / (name + ".vxm"));
        exported.write_vdb(folder / (name + ".vdb"));
    }

    void expect_refused(const std::string& name, Surface surface, const std::string& part) const {
        try {
            read_voxel_model(folder / name, surface);
            ADD_FAILURE() << name << " is accepted";
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << error.what();
            EXPECT_THAT(error.what(), testing::HasSubstr(part));
        }
    }
};

TEST_F(VoxelModels, OfAModelFileRenderAsTheirMeshToTheBit) {
    for (const auto& [surface, name] : {std::pair{Surface::cubes, "cubes"},
                                        {Surface::smooth, "smooth"},
                                        {Surface::exact, "exact"}}) {
        voxelize_to(name, surface);
        const std::string as = std::string(R"(, "surface": ")") + name + "\"}";
        const Image mesh = rendered(R"({"mesh": "m.obj", "voxel_size": 0.05)" + as, "");
        const Image voxels = rendered(std::string(R"({"voxels": ")") + name + ".vxm\"" + as, "");
        for (const char* color : kColors) {
            if (surface != Surface::exact) {
                EXPECT_EQ(mesh.planes.at(color), voxels.planes.at(color)) << name;
                continue;
            }
            for (size_t i = 0; i < mesh.planes.at(color).size(); ++i)
                EXPECT_NEAR(mesh.planes.at(color)[i], voxels.planes.at(color)[i], 1e-3) << i;
        }
    }
}

TEST_F(VoxelModels, KeepTheNormalsOfTheirCubes) {
    voxelize_to("soft", Surface::cubes, CubeNormals::surface);
    const std::string model = R"({"mesh": "m.obj", "voxel_size": 0.05, "surface": "cubes")";
    const Image hard = rendered(model + "}", "");
    for (const char* more :
         {"", R"(, {"model": "thing", "placement": "instance", "position": [-0.4, 0, 0.2]})",
          R"(, {"model": "thing", "scale": [1, -1, 1], "turn": [20, 0, 0]})"}) {
        const Image mesh = rendered(model + R"(, "normals": "surface"})", "", more);
        const Image voxels = rendered(R"({"voxels": "soft.vxm"})", "", more);
        for (const char* color : kColors)
            EXPECT_EQ(mesh.planes.at(color), voxels.planes.at(color)) << more;
        EXPECT_NE(mesh.planes.at("R"), hard.planes.at("R"));
    }
}

TEST_F(VoxelModels, OfOpenVdbRenderAsTheirMesh) {
    for (const auto& [surface, name] :
         {std::pair{Surface::cubes, "cubes"}, {Surface::smooth, "smooth"}}) {
        voxelize_to(name, surface);
        const std::string as = std::string(R"(, "surface": ")") + name + "\"}";
        const Image mesh = rendered(R"({"mesh": "m.obj", "voxel_size": 0.05)" + as, "");
        const Image voxels = rendered(std::string(R"({"voxels": ")") + name + ".vdb\"" + as, "");
        size_t different = 0;
        for (size_t i = 0; i < mesh.planes.at("R").size(); ++i)
            different += std::abs(mesh.planes.at("R")[i] - voxels.planes.at("R")[i]) > 1e-3f;
        EXPECT_LE(different, surface == Surface::cubes ? 0u : 3u) << name;
    }
}

TEST_F(VoxelModels, ThatAreDamagedOrAnotherSurfaceAreRefusedInOneSentence) {
    voxelize_to("a", Surface::cubes);
    const std::string bytes = bytes_of(folder / "a.vxm"), vdb = bytes_of(folder / "a.vdb");
    put_bytes(folder / "b.vxm", bytes.substr(0, bytes.size() / 2));
    put_bytes(folder / "b.vdb", vdb.substr(0, vdb.size() / 2));
    put_bytes(folder / "c.vxm", "solid");
    expect_refused("a.vxm", Surface::smooth, "\"surface\": \"cubes\"");
    expect_refused("b.vxm", Surface::cubes, "truncated");
    expect_refused("a.vdb", Surface::smooth, "has no level set");
    expect_refused("a.vdb", Surface::exact, "no exact surface");
    expect_refused("b.vdb", Surface::cubes, "not a readable OpenVDB file");
    expect_refused("c.vxm", Surface::cubes, "too short for a voxelume model");
    put_bytes(folder / "c.ball", "solid");
    expect_refused("c.ball", Surface::cubes, "is of no format of voxels that voxelume reads");
    expect_refused("d.vxm", Surface::cubes, "d.vxm");
    for (size_t i = 0; i < bytes.size(); i += 97) {
        std::string changed = bytes;
        changed[i] = char(changed[i] ^ 0x41);
        put_bytes(folder / "e.vxm", changed);
        try {
            read_voxel_model(folder / "e.vxm", Surface::cubes);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << i;
        }
    }
}

// A fuzzer found that one without bricks was read.
TEST_F(VoxelModels, WithoutVoxelsAreRefused) {
    for (const Surface surface : {Surface::cubes, Surface::smooth}) {
        voxelize_to("a", surface);
        ModelFile file = read_model_file(folder / "a.vxm");
        if (surface == Surface::cubes) {
            ModelFile hollow = file;
            std::ranges::fill(std::get<std::vector<uint64_t>>(hollow.arrays.at("occupancy")), 0);
            write_model_file(folder / "hollow.vxm", hollow);
            expect_refused("hollow.vxm", surface, "hollow.vxm: has no voxels to show");
        }
        std::ranges::fill(std::get<std::vector<uint32_t>>(file.arrays.at("slots")), kBrickInside);
        for (const char* name : {"coordinates", "occupancy", "distance", "attributes"})
            file.arrays.erase(name);
        write_model_file(folder / "none.vxm", file);
        expect_refused("none.vxm", surface, "none.vxm: has no voxels to show");
    }
}

TEST_F(VoxelModels, OfOpenVdbThatAreDamagedAnywhereAreRefusedOrRead) {
    // OpenVDB's reader itself corrupts memory on some of these.
    voxelize_to("a", Surface::cubes);
    const std::string bytes = bytes_of(folder / "a.vdb");
    size_t refused = 0;
    const size_t places = is_exhaustive() ? 80 : 40;
    for (size_t i = 0; i < bytes.size(); i += bytes.size() / places) {
        std::string changed = bytes;
        changed[i] = char(changed[i] ^ 0x41);
        put_bytes(folder / "b.vdb", changed);
        try {
            read_voxel_model(folder / "b.vdb", Surface::cubes);
        } catch (const Error& error) {
            EXPECT_EQ(error.kind(), ErrorKind::input) << i;
            ++refused;
        }
    }
    EXPECT_GT(refused, 20u);
}

TEST_F(VoxelModels, ThatSpanTooMuchAreRefusedBeforeMemoryIsTaken) {
    const auto write = [&](const glm::ivec3& first, const glm::ivec3& last) {
        const std::vector<glm::ivec3> cells = {first, last};
        const std::vector<float> values = {1, 1};
        VdbVolume volume;
        volume.cells = cells;
        volume.values = values;
        write_vdb(folder / "far.vdb", volume);
    };
    write({0, 0, 0}, {1, 70000, 2});
    expect_refused("far.vdb", Surface::cubes, "span 10 x 70009 x 11");
    write({0, 0, 0}, {60000, 60000, 60000});
    expect_refused("far.vdb", Surface::cubes, "bricks of 16");
    write({2147483640, 0, 0}, {2147483646, 3, 4});
    expect_refused("far.vdb", Surface::cubes, "farther from its origin");
}

}  // namespace
}  // namespace voxelume
