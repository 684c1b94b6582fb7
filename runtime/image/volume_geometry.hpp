// SPDX-License-Identifier: Apache-2.0
// The positions of a volumetric image's voxels, in the observer's coordinates and in the world.
#pragma once

#include <cstdint>
#include <glm/mat4x4.hpp>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <optional>
#include <string>

#include "runtime/image/volume.hpp"

namespace voxelume {

inline constexpr int kMaxVolumeSide = 65536;  ///< maximum of voxels along one axis

/// The number of voxels: size.x * size.y * size.z.
uint64_t voxel_count(const VolumeFrame& frame);

/// The voxel whose number, as `indices` have it, is `index`.
glm::ivec3 cell_of(const VolumeFrame& frame, uint64_t index);

/// True if depths count along Z_E, false if along the sight ray.
bool depth_is_along_z(const VolumeFrame& frame);

/// The matrix from voxel coordinates, where voxel (i,j,k) fills [(i,j,k), (i,j,k)+1], to the world
/// in metres. Empty where no matrix does this: sight rays that aren't parallel.
std::optional<glm::dmat4> world_from_voxels(const VolumeFrame& frame);

/// The point of the sight ray through pixel coordinates `uv` at `depth` metres, in the observer's
/// coordinates. `uv` = (i, j) + 0.5 is the middle of column i, row j. Only for layout `rays`.
glm::dvec3 point_on_ray(const VolumeFrame& frame, glm::dvec2 uv, double depth);

/// The factors from the depth of a point on a sight ray to the values that image files store for
/// it.
struct DepthScales {
    double z = 1;         ///< for Z: along Z_E, or the distance where the display looks backwards
    double distance = 1;  ///< along the ray, from the observer or in a box from its plane
};

/// The scales of the sight ray through pixel coordinates `uv`. Only for layout `rays`.
DepthScales depth_scales(const VolumeFrame& frame, glm::dvec2 uv);

/// The middle of a voxel in the world, metres. For layout `rays` it is the middle of the step.
glm::dvec3 voxel_center(const VolumeFrame& frame, glm::ivec3 cell);

/// Describes what is wrong with a volume, as a part of a sentence; empty if nothing is. Checks
/// sizes, edges, numbers that aren't finite, arrays of different lengths, indices out of order or
/// range, and opacities outside 0..1.
std::string find_fault(const Volume& volume);
std::string find_fault(const VolumeFrame& frame);

}  // namespace voxelume
