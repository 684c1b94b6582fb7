// SPDX-License-Identifier: Apache-2.0
// The colours of a binary STL file's facets, as two programs write them into the attribute words.
#pragma once

#include "runtime/io/mesh/mesh_color.hpp"
#include "runtime/io/mesh/mesh_paint.hpp"

#include <cstdint>
#include <string>
#include <string_view>

namespace voxelume {

/// Gives a mesh the colours of its facets, of five bits a channel.
///
/// Materialise Magics writes "COLOR=" and four bytes RGBA into the header: facets whose word has
/// its highest bit set have that colour. Other facets have red in the lowest bits of their words.
/// VisCAM has no such header: the highest bit marks a facet with a colour, whose blue is in the
/// lowest bits. Facets without a colour are white.
class StlColors {
  public:
    explicit StlColors(const std::string& bytes) {
        constexpr std::string_view kMark = "COLOR=";
        const size_t mark = std::string_view(bytes).substr(0, 80).find(kMark);
        if (mark == std::string_view::npos || mark + kMark.size() + 4 > 80) return;
        has_header_ = true;
        const auto level = [&](size_t i) {
            return static_cast<unsigned char>(bytes[mark + kMark.size() + i]) / 255.0;
        };
        of_part_ = linear_from_srgb(glm::dvec3(level(0), level(1), level(2)));
    }

    /// Takes the colour of the mesh's last facet from the two bytes of its attribute word.
    void add(const char* attribute, Mesh& mesh) const {
        const auto byte = [&](int i) { return unsigned{static_cast<unsigned char>(attribute[i])}; };
        const unsigned word = byte(0) | byte(1) << 8;
        const bool is_marked = (word & 0x8000u) != 0;
        if (!has_header_ && !is_marked) return;
        const auto level = [&](unsigned shift) { return (word >> shift & 31u) / 31.0; };
        const glm::dvec3 lowest_first(level(0), level(5), level(10));
        glm::vec3 color = of_part_;
        if (!has_header_)
            color = linear_from_srgb(glm::dvec3(lowest_first.z, lowest_first.y, lowest_first.x));
        else if (!is_marked)
            color = linear_from_srgb(lowest_first);
        append_face_color(mesh, color, mesh.triangles.size() - 1);
    }

  private:
    bool has_header_ = false;
    glm::vec3 of_part_{1.0f};
};

}  // namespace voxelume
