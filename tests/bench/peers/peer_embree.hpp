// SPDX-License-Identifier: Apache-2.0
// Embree 3 on a tessellated solid.
#pragma once

#include <vector>

#include "runtime/verify/bench/bench_truth.hpp"
#include "tests/bench/peers/peer_image.hpp"

namespace voxelume {

/// A mesh with a margin after the positions, because Embree reads them in blocks of 16 bytes.
struct PeerMesh {
    std::vector<glm::vec3> positions;  ///< metres in the world, on the surface
    std::vector<glm::uvec3> triangles;
};

/// A sphere of `rings` by 2 `rings` quadrilaterals, or a torus with these numbers around the tube
/// and the ring; each quadrilateral is cut into two triangles.
PeerMesh tessellated(const BenchSolid& solid, int rings);

/// The program's name and version: "Embree 3.13.5".
std::string embree_name();

/// Builds a watertight scene of medium quality and traces packets of 16 coherent rays.
PeerTimes run_embree(const PeerMesh& mesh, const BenchTruth& truth, Image& image);

}  // namespace voxelume
