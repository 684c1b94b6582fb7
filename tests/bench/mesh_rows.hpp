// SPDX-License-Identifier: Apache-2.0
// Common parts of benchmarks of a mesh: the default mesh, medians, rows.
#pragma once

#include <fmt/format.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <string>
#include <vector>

#include "runtime/geometry/mesh_summary.hpp"
#include "tests/bench/cpu_time.hpp"

namespace voxelume {

/// Debian's bunny (glmark2-data), the default mesh of benchmarks.
inline constexpr const char* kDebianBunny = "/usr/share/glmark2/models/bunny.obj";

struct Milliseconds {
    double wall = 0;
    double cpu = 0;  ///< of all threads
};

template <class Run>
Milliseconds time_of(const Run& run) {
    const auto start = std::chrono::steady_clock::now();
    const double cpu = cpu_seconds();
    run();
    return {
        std::chrono::duration<double, std::milli>(std::chrono::steady_clock::now() - start).count(),
        1e3 * (cpu_seconds() - cpu)};
}

/// The median of five runs, after one that isn't counted.
template <class Run>
Milliseconds median_time(const Run& run) {
    constexpr int kTurns = 5;
    std::vector<double> wall, cpu;
    run();
    for (int turn = 0; turn < kTurns; ++turn) {
        const Milliseconds time = time_of(run);
        wall.push_back(time.wall);
        cpu.push_back(time.cpu);
    }
    return {median_of(wall), median_of(cpu)};
}

inline void print_time(const std::string& name, int voxels, const Milliseconds& time,
                       const std::string& note) {
    fmt::print("{:26}{:6}{:10.1f}{:10.1f}  {}\n", name, voxels, time.wall, time.cpu, note);
    std::fflush(stdout);
}

/// The arguments [MESH] [voxels ... | peers].
struct MeshArguments {
    std::string mesh = kDebianBunny;
    std::vector<int> voxels;
    bool with_peers = false;

    MeshArguments(int count, char** words) {
        for (int i = 1; i < count; ++i) {
            const std::string word = words[i];
            const int number = std::atoi(word.c_str());
            if (word == "peers")
                with_peers = true;
            else if (number > 0 && word == std::to_string(number))
                voxels.push_back(number);
            else
                mesh = word;
        }
    }
};

inline void print_heading(const std::string& path, const Mesh& mesh) {
    fmt::print("{}, {} triangles\n{:26}{:>6}{:>10}{:>10}\n", path, mesh.triangles.size(), "", "n",
               "ms", "CPU ms");
}

inline double longest_side(const Mesh& mesh) {
    const Bounds box = mesh_bounds(mesh);
    const glm::dvec3 size = box.max - box.min;
    return std::max({size.x, size.y, size.z});
}

}  // namespace voxelume
