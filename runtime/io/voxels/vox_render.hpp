// SPDX-License-Identifier: Apache-2.0
// Chunks rCAM and rOBJ of a .vox file -> its cameras, and the light and settings of its pictures.
#pragma once

#include <glm/vec3.hpp>
#include <optional>
#include <set>
#include <string>

#include "runtime/io/voxels/vox_chunks.hpp"

namespace voxelume {

enum class VoxCameraKind : uint8_t { perspective, free, orthographic, isometric, panoramic, other };

/// A camera that looks at a point. With all angles 0 it looks along +Y of the file. Roll turns it
/// about its sight line, counterclockwise as it sees it, then pitch raises the sight line, then yaw
/// turns it to the left.
struct VoxCamera {
    VoxCameraKind kind = VoxCameraKind::perspective;
    glm::dvec3 focus{0};                  ///< voxels
    double pitch = 0, yaw = 0, roll = 0;  ///< degrees
    double radius = 0;   ///< voxels from the focus; 0 for an entry of the list that isn't used
    double frustum = 0;  ///< half of the picture's height: a tangent, or voxels
    std::optional<double> angle;  ///< degrees from the picture's top to its bottom
};

/// The render settings. Colours are 0..255 in sRGB, strengths those of MagicaVoxel.
struct VoxRender {
    bool is_there = false;
    double sun = 0.7;  ///< strength
    glm::dvec3 sun_color{255};
    double sun_pitch = 50, sun_yaw = 50;  ///< degrees; where the sun stands
    double sun_area = 0.07;               ///< radius of its disk
    double sky = 0.7;                     ///< strength
    glm::dvec3 sky_color{255};
    int sky_mode = 0;  ///< 0: one colour; 1: a picture; 2: an atmosphere
    double fog = 0;    ///< density
    glm::dvec3 fog_color{255};
    double angle = 45;    ///< degrees, of cameras without one
    double exposure = 1;  ///< a factor
    bool has_ground = true;
    glm::dvec3 ground{80};
    bool has_background = false;  ///< the background replaces the sky in the picture
    glm::dvec3 background{0};
    std::set<std::string> not_shown;  ///< enabled settings that pictures don't show
};

/// Takes a camera from a chunk rCAM.
VoxCamera take_camera(VoxContent& content);

/// Takes one kind of settings from a chunk rOBJ.
void take_render_settings(VoxContent& content, VoxRender& render);

}  // namespace voxelume
