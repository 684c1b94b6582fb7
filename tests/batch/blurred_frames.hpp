// SPDX-License-Identifier: Apache-2.0
// A scene that moves while a shutter is open, and each of its samples as a separate image.
#pragma once

#include <algorithm>
#include <memory>
#include <nlohmann/json.hpp>
#include <string>
#include <utility>
#include <vector>

#include "runtime/batch/render_frames.hpp"
#include "tests/batch/moving_frames.hpp"

namespace voxelume {

using Json = nlohmann::json;

inline constexpr int kSamples = 8, kFrame = 3;

inline Json track(const char* target, const Json& from, const Json& to, int first = 1,
                  int last = 9) {
    return {{"target", target},
            {"keys", {{{"frame", first}, {"value", from}}, {{"frame", last}, {"value", to}}}}};
}

/// A ball flies, a box of cubes in the world's own voxels turns, a light fades, and the observer
/// walks, until frame 9. Behind them is a wall, and nothing is around the wall.
inline Json blurred_json() {
    Json json = Json::parse(R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-1, -1, -1], "max": [1, 1, 1]},
          "ambient": [0.2, 0.2, 0.2]},
"materials": {"red": {"color": [0.8, 0.2, 0.1]}, "blue": {"color": [0.1, 0.3, 0.8]}},
"models": {"ball": {"shape": "sphere", "radius": 0.3, "voxel_size": 0.05, "surface": "smooth"},
           "box": {"shape": "box", "size": [0.4, 0.4, 0.4], "surface": "cubes"},
           "wall": {"shape": "box", "size": [1.8, 1.2, 0.1], "surface": "exact"}},
"objects": [{"name": "ball", "model": "ball", "material": "red", "position": [-0.6, 0, -0.3]},
            {"name": "box", "model": "box", "material": "blue", "position": [0.5, -0.4, 0]},
            {"name": "wall", "model": "wall", "position": [0, 0, 0.7]}],
"lights": [{"name": "key", "type": "point", "position": [1, 3, -3], "intensity": 20}],
"observer": {"position": [0, 0.5, -4], "look_at": [0, 0, 0], "shutter": 0.75,
             "display": {"shape": "pyramid", "angles": [50, 40], "near": 0.5, "far": 20,
                         "voxels": [9, 7, 11]}},
"render": {"size": [45, 31]}, "animation": {"frames": 9}})");
    json["render"]["samples"] = kSamples;
    json["animation"]["tracks"] = {
        track("objects.ball.position", {-0.6, 0, -0.3}, {0.6, 0.3, -0.3}),
        track("objects.box.turn", {0, 0, 0}, {200, 100, 0}), track("lights.key.intensity", 25, 5),
        track("observer.position", {0, 0.5, -4}, {1, 0.5, -4})};
    return json;
}

inline Scene scene_of(const Json& json) {
    return parse_scene(json.dump(), "shutter.json", {});
}

struct Rendered {
    std::shared_ptr<const Image> image;
    std::shared_ptr<Volume> volume;
    RenderReport report;
};

inline std::vector<Rendered> rendered_frames(const Scene& scene, BatchOptions options,
                                             int lanes = 0) {
    std::vector<Rendered> frames;
    render_frames({test_device(lanes)}, scene, std::move(options), [&](const FrameResult& result) {
        frames.push_back({result.image, result.volume, result.report.report});
    });
    return frames;
}

inline Rendered rendered(const Scene& scene, int frame = kFrame, int lanes = 0) {
    return rendered_frames(scene, {.frames = {frame}}, lanes).at(0);
}

inline uint64_t hash_of(const Scene& scene, int frame = kFrame, int lanes = 0) {
    return oracle::image_hash(*rendered(scene, frame, lanes).image);
}

/// A frame's samples, each as an image of its own moment; the paper calls that image a frame.
inline std::vector<Image> samples_alone(const Scene& scene, int count = kSamples) {
    std::vector<Image> images;
    for (int sample = 0; sample < count; ++sample) {
        // The moments of 8 samples, by their definition.
        constexpr double kEighths[] = {0, 4, 2, 6, 1, 5, 3, 7};
        Scene now = scene_at(scene, kFrame + 0.75 * kEighths[sample] / 8);
        now.render.first_sample = sample;
        now.render.samples = 1;
        RenderReport report;
        images.push_back(render(test_device(), now, report));
    }
    return images;
}

/// Expects a plane to be the mean of its samples' planes. A sum of 8 floats is right within 7 half
/// units in the last place of the largest, 4.2e-7 of it.
inline void expect_means(const Image& image, const std::vector<Image>& samples,
                         const std::string& plane) {
    const Plane<float>& values = image.planes.at(plane);
    double maximum = 0;
    for (size_t pixel = 0; pixel < values.size(); ++pixel) {
        double sum = 0, largest = 0;
        for (const Image& sample : samples) {
            const double value = double(sample.planes.at(plane)[pixel]);
            sum += value;
            largest = std::max(largest, value);
        }
        const double mean = sum / double(samples.size());
        ASSERT_NEAR(double(values[pixel]), mean, 5e-7 * largest) << plane << " of " << pixel;
        maximum = std::max(maximum, largest - mean);
    }
    EXPECT_GT(maximum, 0.05) << plane << " doesn't change";
}

}  // namespace voxelume
