// SPDX-License-Identifier: Apache-2.0
// Other programs that trace the rays of bench_trace, on one thread.
#pragma once

#include <functional>
#include <glm/vec3.hpp>
#include <memory>
#include <string>
#include <vector>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// A ray in metres; `direction` has length 1.
struct PeerRay {
    glm::vec3 origin{0}, direction{0};
};

enum class PeerQuery { closest_coherent, occluded_coherent, closest_incoherent };

/// A peer's pass over rays in its own layout; returns how many of them hit.
using PeerPass = std::function<size_t()>;

struct TracePeer {
    std::string name;
    double build_seconds = 0;  ///< CPU time of all threads
    std::function<PeerPass(const std::vector<PeerRay>& rays, PeerQuery query)> prepare;
};

/// Embree 3 with packets of 1, 8 and 16 rays; none where it isn't installed.
std::vector<TracePeer> embree_tracers(const Mesh& mesh);

/// OpenVDB's and NanoVDB's intersectors of the mesh's level set, three voxels wide on each side.
std::vector<TracePeer> level_set_tracers(const Mesh& mesh, double voxel);

}  // namespace voxelume
