// SPDX-License-Identifier: Apache-2.0
// A scene of nine frames, the hashes of its frames, and two devices to render it on.
#pragma once

#include <map>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {

/// A scene of nine frames with a ball that moves until the fifth. The device has memory for many
/// more frames.
inline Scene moving_scene() {
    constexpr const char* kText = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.4, "voxel_size": 0.05, "surface": "smooth"}},
"objects": [{"name": "a", "model": "ball"}, {"name": "b", "model": "ball", "position": [0.5, 0, 0]}],
"lights": [{"type": "point", "position": [1, 3, -3], "intensity": 20}],
"observer": {"position": [0, 0.5, -5], "look_at": [0, 0, 0],
             "display": {"shape": "pyramid", "angles": [50, 40], "near": 0.5, "far": 20,
                         "voxels": [9, 7, 11]}},
"render": {"size": [45, 31]},
"animation": {"frames": 9, "tracks": [{"target": "objects.a.position",
    "keys": [{"frame": 1, "value": [-0.5, 0, 0]}, {"frame": 5, "value": [-0.1, 0.1, 0]}]}]}})";
    return parse_scene(kText, "moving.json", {});
}

inline std::vector<Device> halves() {
    const Device whole = test_device();
    const bool is_cut = whole.is_cpu() && whole.info().compute_units > 1;
    return is_cut ? Device::open_all("all/2") : std::vector{whole, whole.with_own_queue()};
}

inline uint64_t hash_alone(int frame) {
    static std::map<int, uint64_t> hashes;
    if (const auto known = hashes.find(frame); known != hashes.end()) return known->second;
    RenderReport report;
    const Image image = render(test_device(), scene_at(moving_scene(), frame), report);
    return hashes[frame] = oracle::image_hash(image);
}

}  // namespace voxelume
