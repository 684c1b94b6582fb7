// SPDX-License-Identifier: Apache-2.0
// A scene of one object, and its memory plan.
#pragma once

#include "runtime/memory/plan.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

class PlanTest : public FileTest {
  protected:
    Scene scene_of(const std::string& model, double voxel, const std::string& animation = "") {
        const bool has_lights =
            std::string_view(animation).find("\"lights\"") != std::string_view::npos;
        const std::string text =
            fmt::format(R"({{
            "voxelume": 1, {}
            "world": {{"voxel_size": {}, "bounds": {{"min": [0,0,0], "max": [1,0.9,0.8]}}}},
            "models": {{"thing": {}}},
            "objects": [{{"name": "thing", "model": "thing", "position": [0.5011,0.4007,0.4013]}}],
            {} "observer": {{"position": [0.5,0.4,3], "look_at": [0.5,0.4,0.4],
                "display": {{"shape": "pyramid", "angles": [40,30], "near": 0.1, "far": 8,
                            "voxels": [8,6,4]}}}},
            "render": {{"size": [8, 6]}}}})",
                        animation, voxel, model, has_lights ? "" : R"("lights": [],)");
        return parse_scene(text, folder / "scene.json", {});
    }
    ScenePlan plan_of(const Scene& scene) {
        AssetStore meshes;
        return plan_scene(scene, meshes);
    }
};

}  // namespace voxelume
