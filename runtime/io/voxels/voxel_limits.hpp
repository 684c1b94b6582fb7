// How many voxels and bricks a model from a file may have.
#pragma once

#include <cstddef>
#include <glm/vec3.hpp>

namespace voxelume {

class InputFile;

/// Throws Error::input for more voxels along the axes than a model may have, or for more bricks,
/// stored or not.
void check_voxel_span(const glm::dvec3& size, const InputFile& file);

/// Throws Error::input for more stored bricks than a model may have.
void check_stored_bricks(size_t stored, const InputFile& file);

}  // namespace voxelume
