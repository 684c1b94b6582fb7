// SPDX-License-Identifier: Apache-2.0
// mesh -> chords of its body along the axes.
#pragma once

#include <functional>
#include <glm/vec3.hpp>

#include "runtime/geometry/mesh.hpp"

namespace voxelume {

/// The part of a line that lies in the body, from a face that turns to the line more than to the
/// other axes.
struct Chord {
    glm::dvec3 entry, exit;  ///< metres
    double thickness;        ///< metres: its length times the cosine at its entry
    double area;             ///< square metres of the entry's face that it stands for
    /// The faces at both ends look away from each other, to 60 degrees.
    bool is_between_walls = false;
    /// The faces at both ends are parallel to 6 degrees, which is rare next to sharp edges.
    bool is_in_sheet = false;
};

/// Gives `add` the chords of lines along x, then y, then z: regular lattices that divide each side
/// of the mesh's box by `lines`, at most 8192. They are in the order of the lines and the
/// triangles, so equal meshes give equal chords. False if more than 4 million crossings lie on 64
/// rows of lines, or on all of a lattice of 64 x 64: such a mesh has no inside.
bool for_each_chord(const Mesh& mesh, const glm::ivec3& lines,
                    const std::function<void(const Chord&)>& add);

}  // namespace voxelume
