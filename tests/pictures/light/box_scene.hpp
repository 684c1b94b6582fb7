// SPDX-License-Identifier: Apache-2.0
// A scene of one box, its image, and what rendering it took.
#pragma once

#include <string>

#include "runtime/render/renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/interpreted.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

/// A scene text with one unit-sized box, 7 x 5 x 3 voxels, seen along +Z from in front of it.
inline std::string box_scene(const std::string& surface, const std::string& lights,
                             const std::string& more_world = "") {
    return R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "background": [0.25, 0.5, 0.75], "ambient": [0.5, 0.25, 0.125])" +
           more_world + R"(},
"materials": {"paint": {"color": [0.8, 0.4, 0.2], "diffuse": 0.5, "specular": 0.25, "shininess": 8}},
"models": {"box": {"shape": "box", "size": [0.7, 0.5, 0.3], "voxel_size": 0.1, "surface": ")" +
           surface + (surface == "cubes" ? R"(", "set": "solid"}},)" : R"("}},)") + R"(
"objects": [{"name": "b", "model": "box", "material": "paint", "position": [0.05, -0.05, 0.05]}],
"lights": [)" +
           lights + R"(],
"observer": {"position": [0, 0, -3], "look_at": [0, 0, 0],
             "display": {"shape": "box", "size": [1.6, 1.2, 4], "near": 0.5, "voxels": [8, 6, 4]}},
"render": {"size": [16, 12]}})";
}

inline Scene scene_of(const std::string& text) {
    return parse_scene(text, "test.json", {});
}

/// The number of pixels along an edge.
inline int pixels(int count) {
    return int(full_or(uint32_t(count) / 4, uint32_t(count)));
}

struct Rendered {
    Image image;
    RenderReport report;
    DeviceCounters counters;

    float at(const char* plane, int x, int y) const {
        return image.planes.at(plane)[size_t(y * image.width + x)];
    }
};

inline Rendered rendered(const Scene& scene, int lanes = 0) {
    const Device device = test_device(lanes);
    Rendered result;
    result.image = render(device, scene, result.report);
    result.counters = device.counters();
    return result;
}

}  // namespace voxelume
