// SPDX-License-Identifier: Apache-2.0
// Scenes of solids that tests show as instances, and readers of their images.
#pragma once

#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {

/// Balls and blocks of one surface over a ground of cubes, each with the same placement; two
/// lights, one of the objects is a mirror. `objects` is a list of JSON objects without materials.
inline Scene instance_scene(const std::string& surface, const std::string& placement,
                            const std::vector<std::string>& objects) {
    const std::string set = surface == "cubes" ? R"(, "set": "solid")" : "";
    std::string list;
    for (size_t i = 0; i < objects.size(); ++i)
        list += fmt::format(R"({{"placement": "{}", "material": "m{}", {}}}, )", placement, i % 3,
                            objects[i]);
    return parse_scene(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.01, "bounds": {{"min": [-0.9, -0.6, -0.8], "max": [0.9, 0.9, 0.8]}},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.1, 0.1]}},
"materials": {{"m0": {{"color": [0.8, 0.5, 0.3]}}, "m1": {{"color": [0.3, 0.8, 0.4], "specular": 0.4}},
              "m2": {{"diffuse": 0.3, "reflection": 0.6}}, "ground": {{"color": [0.7, 0.7, 0.6]}}}},
"models": {{"ball": {{"shape": "sphere", "radius": 0.2, "voxel_size": 0.01, "surface": "{0}"{1}}},
           "block": {{"shape": "box", "size": [0.14, 0.36, 0.22], "voxel_size": 0.01, "surface": "{0}"{1}}},
           "ground": {{"shape": "box", "size": [1.7, 0.1, 1.5], "surface": "cubes", "set": "solid"}}}},
"objects": [{2} {{"model": "ground", "material": "ground", "position": [0, -0.5, 0]}}],
"lights": [{{"type": "point", "position": [0.7, 0.8, -0.7], "intensity": 1}},
           {{"type": "directional", "direction": [0.3, -1, 0.4], "intensity": 0.5}}],
"observer": {{"position": [0.2, 0.4, -1.9], "look_at": [0, 0, 0],
             "display": {{"shape": "pyramid", "angles": [50, 40], "near": 0.1, "far": 10}}}},
"render": {{"size": [200, 160], "depth": 2}}}})",
                                   surface, set, list),
                       "test.json", {});
}

/// Objects moved by whole voxels, turned by quarters, and mirrored.
inline std::vector<std::string> whole_voxel_objects() {
    return {
        R"("model": "ball", "position": [-0.5, 0.11, 0.2])",
        R"("model": "block", "position": [0.34, -0.05, 0.1], "turn": [90, 0, 0])",
        R"("model": "block", "position": [0.05, 0.4, 0.3], "turn": [0, 90, 180], "scale": [1, -1, 1])",
        R"("model": "ball", "position": [0.1, -0.13, -0.3])"};
}

/// Objects turned by arbitrary angles, stretched, mirrored and sheared.
inline std::vector<std::string> turned_objects() {
    return {
        R"("model": "ball", "position": [-0.5, 0.112, 0.203], "turn": [20, 30, 5])",
        R"("model": "block", "position": [0.343, -0.05, 0.1], "turn": [33, 11, 7])",
        R"("model": "ball", "position": [0.05, 0.4, 0.3], "turn": [0, 40, 180], "scale": [1.3, -0.7, 1])",
        R"("model": "ball", "matrix": [[1, 0.4, 0, 0.2], [0, 1, -0.3, -0.13], [0.2, 0, 0.8, -0.3]])"};
}

inline Image image_of_scene(const Scene& scene, const Device& device = shared_device()) {
    RenderReport report;
    Image image = render(device, scene, report);
    EXPECT_EQ(report.not_finite, 0u);
    return image;
}

inline glm::dvec3 vector_at(const Image& image, const std::string& plane, size_t pixel) {
    return {image.planes.at(plane + ".X")[pixel], image.planes.at(plane + ".Y")[pixel],
            image.planes.at(plane + ".Z")[pixel]};
}

}  // namespace voxelume
