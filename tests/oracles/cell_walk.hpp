// SPDX-License-Identifier: Apache-2.0
// The cells that a ray passes, in order, by exact integer arithmetic: Amanatides & Woo 1987 with
// times compared as fractions. The oracle shares no code with the kernels.
#pragma once

#include <glm/vec3.hpp>
#include <set>
#include <tuple>
#include <vector>

namespace voxelume::oracle {

struct CellOrder {
    bool operator()(const glm::ivec3& a, const glm::ivec3& b) const {
        return std::tie(a.x, a.y, a.z) < std::tie(b.x, b.y, b.z);
    }
};
using VoxelSet = std::set<glm::ivec3, CellOrder>;

struct FirstHit {
    bool hit = false;
    glm::ivec3 cell{0};
    int axis = 3;  ///< across which the cell was entered; 3: the ray began there
    double t = 0;
};

/// The first cell of `voxels` that the ray o + d t passes in a grid. `o` is a multiple of
/// 2^-fraction_bits and `d` of 2^-22. A point on a plane belongs to the cell being entered;
/// crossings at the same t are taken lowest axis first.
FirstHit first_hit(const glm::dvec3& o, const glm::dvec3& d, const glm::ivec3& size,
                   int fraction_bits, const VoxelSet& voxels);

/// A cell that a ray passes, and the times at which it enters and leaves it.
struct CrossedCell {
    glm::ivec3 cell{0};
    double t_in = 0, t_out = 0;  ///< relative error 2^-52
};

/// All cells of a grid that the ray passes, in order; the ray and its rules are those of first_hit.
std::vector<CrossedCell> cells_crossed(const glm::dvec3& o, const glm::dvec3& d,
                                       const glm::ivec3& size, int fraction_bits);

}  // namespace voxelume::oracle
