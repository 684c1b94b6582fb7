// SPDX-License-Identifier: Apache-2.0
// the emission maps of triangles -> the mean of what a part of a triangle sends out.
#pragma once

#include <array>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <vector>

#include "runtime/stages/light/emissive_pieces.hpp"

namespace voxelume {

/// The emission maps that the triangles of a source wear, in the host's memory.
class EmissionMaps {
  public:
    using Places = std::array<glm::dvec2, 3>;  ///< of a triangle's corners on its map

    /// Reads the textures, but for sources without maps.
    explicit EmissionMaps(const EmissiveSource& source);

    /// The places of the source's triangle number `i`; those of one without a map don't count.
    Places places(size_t i) const;
    /// The mean of the map of triangle number `i` between three places; 1 where it has none.
    glm::dvec3 mean(size_t i, const Places& part) const;

  private:
    /// The number of the first word of a triangle's map; 0: it has none.
    size_t map_of(size_t i) const;

    std::vector<uint32_t> worn_, textures_;
};

}  // namespace voxelume
