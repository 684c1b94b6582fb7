// SPDX-License-Identifier: Apache-2.0
// P, the volumetric image, as the display stage passes it to the writers.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>
#include <vector>

#include "runtime/scene/scene.hpp"

namespace voxelume {

/// The content of a display voxel. Voxels behind a surface are `unseen`: nothing is known of them.
/// Rendering lists no such voxels, but the formats have a number for them.
enum class VoxelKind : uint8_t { space, object, unseen };

/// V, the lattice of display voxels, and its position.
struct VolumeFrame {
    VolumeLayout layout = VolumeLayout::lattice;
    Display display;     ///< the shape that clips it; `display.voxels` gives u, v, k
    glm::ivec3 size{0};  ///< voxels along the three axes of the layout
    /// For layout `lattice`, metres in the observer's coordinates: voxel (i,j,k) fills origin +
    /// edge * [(i,j,k), (i,j,k)+1].
    glm::dvec3 origin{0}, edge{0};
    /// For layout `rays`, metres between steps k: voxel k of a ray spans near + step * [k, k+1],
    /// along Z_E for pyramid and box, along the ray for sector and ball.
    double step = 0;
    glm::dmat4 world_from_observer{1};  ///< rigid
};

/// The voxels of P that show something, as sparse arrays of equal length, in ascending order of
/// `indices`.
///
/// Every voxel that isn't listed is space that shows nothing. Colours are linear Rec. 709 and not
/// multiplied by the opacity.
struct Volume {
    VolumeFrame frame;
    std::vector<uint64_t> indices;  ///< i + size.x * (j + size.y * k)
    std::vector<glm::vec3> colors;  ///< C_P
    std::vector<float> opacities;   ///< 0..1
    std::vector<float> depths;      ///< metres from E: along Z_E for pyramid and box, else along
                                    ///< the sight ray, to what the voxel shows
    std::vector<uint32_t> objects;  ///< number of the object plus 1, 0 for none
    std::vector<VoxelKind> kinds;
    std::map<std::string, std::string> attributes;  ///< text for headers: scene, version, ...

    /// Lists entry `i` of another volume, with the same frame, after all others.
    void append(const Volume& from, size_t i) {
        indices.push_back(from.indices[i]);
        colors.push_back(from.colors[i]);
        opacities.push_back(from.opacities[i]);
        depths.push_back(from.depths[i]);
        objects.push_back(from.objects[i]);
        kinds.push_back(from.kinds[i]);
    }
};

}  // namespace voxelume
