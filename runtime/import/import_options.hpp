// SPDX-License-Identifier: Apache-2.0
// The options of the scene that is made for a file.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "runtime/scene/parts/framing.hpp"

namespace voxelume {

/// The axis of a file's coordinates that points up.
enum class UpAxis : uint8_t { automatic, y, z };

struct ImportOptions {
    std::optional<double> longitude{}, latitude{};  ///< of ViewFrom; none: as the file has them
    double orbit = 0;                               ///< degrees, added to the longitude
    bool is_parallel = false;  ///< the observer's rays are parallel, as in isometric drawings
    /// The observer's display is a lattice around all that is shown, for a volumetric image, and
    /// there is no ground.
    bool is_lattice = false;
    /// The file's own camera, where it has one, is the observer.
    bool has_own_camera = true;
    std::string clip{};  ///< name of a glTF file's; empty: its first
    bool turns = false;  ///< views from all directions around have one distance and one height
    double angle = 40;   ///< degrees, horizontal opening of the observer's pyramid
    std::optional<bool> has_ground{};       ///< none: as the file says, or else one
    std::optional<glm::vec3> background{};  ///< linear Rec. 709; the ground shows the same colour
    bool is_transparent = false;            ///< nothing but the model is shown
    double fit = 0;                         ///< metres of the longest side; 0: the file's own size
    std::optional<glm::dvec3> spacing{};    ///< metres from voxel to voxel, before `up` turns them
    UpAxis up = UpAxis::automatic;          ///< Z for STL, Y for other meshes and voxels
    glm::ivec2 size{800, 600};              ///< pixels
};

}  // namespace voxelume
