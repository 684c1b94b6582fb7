// SPDX-License-Identifier: Apache-2.0
// A valid scene that tests damage, and the warnings that follow.
#pragma once

#include <gmock/gmock.h>

#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "runtime/analysis/warnings/scene_warnings.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"
#include "tests/support/test_meshes.hpp"

namespace voxelume {

using Json = nlohmann::json;

/// A lit ball of 0.6 m on a floor, in a world of 2 x 2 x 2 m with voxels of 0.05 m.
inline constexpr const char* kRightScene = R"({
  "voxelume": 1,
  "world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
  "materials": {"red": {"color": [0.7, 0.3, 0.2]}, "glass": {"refraction": 1}},
  "models": {"ball": {"shape": "sphere", "radius": 0.3, "surface": "smooth"},
             "floor": {"shape": "slab", "thickness": 0.2, "surface": "smooth"}},
  "objects": [{"name": "ball", "model": "ball", "material": "red", "position": [0.1, -0.5, 0]},
              {"name": "floor", "model": "floor", "position": [0, -0.9, 0]}],
  "lights": [{"type": "point", "position": [0.5, 0.8, 0.6]}],
  "observer": {"position": [0, 0, 3], "look_at": [0, -0.5, 0],
               "display": {"shape": "pyramid", "angle": 40}}
})";

class WarnedScene : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        json = Json::parse(kRightScene);
    }

    std::vector<Warning> warnings(std::vector<int> frames = {1}) {
        AssetStore meshes;
        const auto box = [&](const Model& model, bool is_first) {
            return meshes.box_of_file(model, is_first);
        };
        return scene_warnings(parse_scene(json.dump(1), folder / "room.json", {}, box), frames,
                              meshes);
    }
    std::vector<WarningKind> kinds(std::vector<int> frames = {1}) {
        std::vector<WarningKind> found;
        for (const Warning& warning : warnings(std::move(frames))) found.push_back(warning.kind);
        return found;
    }
    /// Makes the ball a mesh of the file `name`, in place of the solid.
    void show_mesh(const std::string& name, const Mesh& mesh) {
        write_obj(folder / name, mesh);
        json["models"]["ball"] = {{"mesh", name}, {"surface", "smooth"}};
    }

    Json json;
};

inline Mesh turned(Mesh mesh) {
    for (glm::uvec3& t : mesh.triangles) std::swap(t.x, t.y);
    return mesh;
}

/// A ball without a cap: the opening has a quarter of its radius.
inline Mesh open_ball(double radius) {
    Mesh mesh = ball({0, 0, 0}, radius, 32, 16);
    std::erase_if(mesh.triangles, [&](const glm::uvec3& t) {
        return mesh.positions[t.x].y > radius * 0.8 && mesh.positions[t.y].y > radius * 0.8;
    });
    return mesh;
}

}  // namespace voxelume
