// SPDX-License-Identifier: Apache-2.0
// Common parts of the peers of `voxelume bench`: times, images, and an image's rows by threads.
#pragma once

#include <atomic>
#include <chrono>
#include <functional>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <thread>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

struct PeerTimes {
    double build = 0, trace = 0;  ///< seconds
};

inline double seconds_since(std::chrono::steady_clock::time_point start) {
    return std::chrono::duration<double>(std::chrono::steady_clock::now() - start).count();
}

inline constexpr const char* kPeerPlanes[] = {"A", "P.X", "P.Y", "P.Z", "N.X", "N.Y", "N.Z"};

inline Image empty_peer_image(glm::ivec2 size) {
    Image image{size.x, size.y, {}, {}, {}};
    for (const char* name : kPeerPlanes)
        image.planes[name] = std::vector<float>(size_t(size.x) * size_t(size.y));
    return image;
}

/// The planes of an image, found once.
struct PeerPlanes {
    explicit PeerPlanes(Image& image) {
        for (size_t i = 0; i < std::size(kPeerPlanes); ++i)
            planes[i] = image.planes.at(kPeerPlanes[i]).data();
    }
    void put(size_t pixel, const glm::dvec3& p, const glm::dvec3& normal) {
        planes[0][pixel] = 1;
        for (size_t axis = 0; axis < 3; ++axis) {
            planes[1 + axis][pixel] = float(p[int(axis)]);
            planes[4 + axis][pixel] = float(normal[int(axis)]);
        }
    }
    void put_miss(size_t pixel) { planes[0][pixel] = 0; }

    float* planes[std::size(kPeerPlanes)];
};

/// Calls `work` with every band of 16 rows, on all of the processor's threads.
inline void for_bands(int rows, const std::function<void(int first, int end)>& work) {
    constexpr int kRows = 16;
    std::atomic<int> next = 0;
    const auto take = [&] {
        for (int row = next.fetch_add(kRows); row < rows; row = next.fetch_add(kRows))
            work(row, std::min(row + kRows, rows));
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(take);
    take();
}

}  // namespace voxelume
