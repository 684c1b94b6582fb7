// SPDX-License-Identifier: Apache-2.0
// OpenVDB's ray intersector on a solid's level set.
#pragma once

#include "runtime/verify/bench/bench_truth.hpp"
#include "tests/bench/peers/peer_image.hpp"

namespace voxelume {

/// The program's name and version: "OpenVDB 10.0.1".
std::string openvdb_name();

/// Samples the distance within 3 voxels of the surface: a sphere with OpenVDB's own function, a
/// torus leaf by leaf on all threads. Then it intersects ray by ray, as its renderer does.
PeerTimes run_openvdb(const BenchSolid& solid, int resolution, const BenchTruth& truth,
                      Image& image);

}  // namespace voxelume
