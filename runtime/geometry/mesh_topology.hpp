// SPDX-License-Identifier: Apache-2.0
// mesh -> whether it is closed, how wide it is open, and whether its faces turn outwards.
#pragma once

#include <cstdint>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

struct MeshTopology {
    /// The number of edges that triangles run along more often in one direction than in the other:
    /// 0 for a closed mesh. Vertices at one position count as one.
    uint64_t open_edges = 0;
    double hole_area = 0;  ///< area of flat lids over all holes, square units of the mesh
    double volume = 0;     ///< negative where faces turn inwards; meaningful where holes are small

    friend bool operator==(const MeshTopology&, const MeshTopology&) = default;
};

/// Finds open edges by sums of hashes, so that a closed mesh costs one pass over its triangles.
/// A lid's area is that of the vector area of its hole's rim: exact for plane holes, less for
/// others.
MeshTopology mesh_topology(const Mesh& mesh);

}  // namespace voxelume
