// SPDX-License-Identifier: Apache-2.0
// A small valid scene for the program, and what must hold when a command fails.
#pragma once

#include <gmock/gmock.h>

#include <algorithm>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

#include "tests/support/program_runner.hpp"

namespace voxelume {

using Json = nlohmann::json;

inline constexpr const char* kScene = R"({
  "voxelume": 1,
  "world": {"voxel_size": 0.1, "bounds": {"min": [0, 0, 0], "max": [3, 2, 1]},
            "ambient": [0.3, 0.3, 0.3]},
  "materials": {"brick": {"color": [0.7, 0.3, 0.2]}},
  "models": {"thing": {"shape": "box", "size": [1.2, 0.8, 0.4], "surface": "cubes"}},
  "objects": [{"name": "thing", "model": "thing", "material": "brick", "position": [1.5, 1, 0.5]}],
  "lights": [{"name": "sun", "type": "directional", "direction": [0.2, -0.5, -1]}],
  "observer": {"position": [1.5, 1, 4], "look_at": [1.5, 1, 0.5],
               "display": {"shape": "pyramid", "angles": [45, 34], "near": 0.1, "far": 8,
                           "voxels": [16, 12, 9]}},
  "render": {"size": [20, 12]}
})";

inline constexpr const char* kTriangle = "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nf 1 2 3\n";

inline constexpr const char* kTetrahedron =
    "v 0 0 0\nv 1 0 0\nv 0 0.7 0\nv 0 0 0.5\nf 1 3 2\nf 1 2 4\nf 2 3 4\nf 3 1 4\n";

/// Puts a disk that shines above the scene's box in place of its light.
inline void lit_by_disk(Json& scene) {
    scene["lights"] = Json::parse(R"([{"type": "disk", "position": [1.5, 1.9, 1.2],
                                       "direction": [0, -1, -0.5], "radius": 0.6}])");
}

/// Tests with the valid scene as scene.json in their folder.
class SceneProgramTest : public ProgramTest {
  protected:
    void SetUp() override {
        ProgramTest::SetUp();
        ASSERT_FALSE(HasFatalFailure());
        write_scene([](Json&) {});
    }

    /// Writes the valid scene, changed by `change`, as scene.json.
    template <class Change>
    void write_scene(const Change& change) {
        Json scene = Json::parse(kScene);
        change(scene);
        put_bytes(folder / "scene.json", scene.dump(1));
    }

    void write_mesh_scene(const std::string& mesh, const std::string& bytes) {
        put_bytes(folder / mesh, bytes);
        write_scene([&](Json& scene) {
            scene["models"]["thing"] = {{"mesh", mesh}, {"surface", "cubes"}};
        });
    }

    /// The names in the folder, except for those that the runner itself writes.
    std::vector<std::string> names() const {
        std::vector<std::string> found;
        for (const auto& entry : std::filesystem::directory_iterator(folder)) {
            const std::string name = entry.path().filename();
            if (name != "stdout.txt" && name != "stderr.txt") found.push_back(name);
        }
        std::ranges::sort(found);
        return found;
    }

    /// Expects that the command fails with this exit code, prints one line after any warnings, and
    /// leaves no file behind.
    std::string expect_failure(int code, const std::string& arguments) const {
        const std::vector<std::string> before = names();
        const ProgramResult result = run(arguments);
        EXPECT_EQ(result.exit_code, code) << arguments << "\n" << result.err;
        EXPECT_THAT(result.err, testing::MatchesRegex("(warning: [^\n]+\n)*voxelume: [^\n]+\n"))
            << arguments;
        EXPECT_THAT(result.out, testing::IsEmpty()) << arguments;
        EXPECT_EQ(names(), before) << arguments;
        return result.err;
    }
    std::string expect_render_failure(int code) const {
        return expect_failure(code, "render scene.json -o out.exr -o out.png");
    }
};

}  // namespace voxelume
