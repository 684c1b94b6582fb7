// SPDX-License-Identifier: Apache-2.0
// the emission maps of triangles -> the mean emission of a part of a triangle.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/stages/light/emissive_pieces.hpp"

namespace voxelume {

/// The emission maps of the triangles of a source, in the host's memory.
class EmissionMaps {
  public:
    using Uvs = std::array<glm::dvec2, 3>;  ///< UVs of a triangle's corners on its map

    /// Reads the textures, unless the source has no maps.
    explicit EmissionMaps(const EmissiveSource& source);

    /// The UVs of the source's triangle number `i`; they don't matter for a triangle without a map.
    Uvs uvs(size_t i) const;
    /// The mean of the map of triangle number `i` between three UVs; 1 without a map.
    glm::dvec3 mean(size_t i, const Uvs& part) const;

  private:
    /// The index of the first word of a triangle's map; 0: it has none.
    size_t map_of(size_t i) const;

    std::vector<uint32_t> worn_, textures_;
};

}  // namespace voxelume
