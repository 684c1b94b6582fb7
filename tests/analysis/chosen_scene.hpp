// SPDX-License-Identifier: Apache-2.0
// Scenes of one model that leave choices to its file.
#pragma once

#include <gmock/gmock.h>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/finned_ball.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {

class ChosenScene : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        write_obj(folder / "ring.obj", wavy_ring(40, 20));
        write_obj(folder / "fin.obj", finned_ball(0.008));
        write_obj(folder / "blade.obj", bladed_ball(0.008));
        write_obj(folder / "box.obj", box({-0.3f, -0.2f, -0.1f}, {0.3f, 0.25f, 0.2f}));
    }

    Scene scene_of(const std::string& model, const std::string& keys = "",
                   const std::string& tracks = "") const {
        const std::string text = fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.02, "bounds": {{"min": [-0.6, -0.5, -0.55], "max": [0.6, 0.5, 0.55]}},
          "ambient": [0.4, 0.4, 0.4]}},
"models": {{"m": {{{}}}}},
"objects": [{{"model": "m"{}}}],
"animation": {{"frames": 4, "tracks": [{}]}},
"observer": {{"position": [0.7, 0.9, -2], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angle": 40}}}},
"render": {{"size": [48, 36]}}}})",
                                             model, keys, tracks);
        AssetStore files;
        return parse_scene(text, folder / "test.json", {}, [&](const Model& of, bool is_first) {
            return files.box_of_file(of, is_first);
        });
    }

    /// The model after the choices are made; its surface is `auto` unless `model` says it.
    Model chosen(std::string model, const std::string& keys = "",
                 const std::string& tracks = "") const {
        if (model.find("\"surface\"") == std::string::npos) model += R"(, "surface": "auto")";
        Scene scene = scene_of(model, keys, tracks);
        AssetStore meshes;
        make_choices(scene, meshes);
        return scene.models[0];
    }

    void voxelize(const char* name, Surface surface) const {
        const Mesh mesh = wavy_ring(40, 20);
        const BrickGrid grid =
            voxelize_mesh(shared_device(), mesh, glm::dmat4(1),
                          frame_around(mesh, glm::dvec3(0.02)), {.surface = surface});
        const VoxelExport voxels(grid, mesh, surface, VoxelSet::supercover);
        const std::filesystem::path file = folder / name;
        file.extension() == ".vxm" ? voxels.write_model(file) : voxels.write_vdb(file);
    }
};

}  // namespace voxelume
