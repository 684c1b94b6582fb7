// SPDX-License-Identifier: Apache-2.0
// A flat image, as the renderer passes it to the writers.
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <map>
#include <string>

#include "runtime/image/plane.hpp"

namespace voxelume {

/// Planes of `width` x `height` values, row 0 at the top, x fastest.
///
/// Float planes have their names in the file: R G B A Z distance P.X P.Y P.Z N.X N.Y N.Z. Colour is
/// linear Rec. 709. Pixels without a hit have Z = distance = +infinity, P = N = 0 and objectId 0;
/// objects count from 1.
struct Image {
    int width = 0;
    int height = 0;
    std::map<std::string, Plane<float>> planes;
    std::map<std::string, Plane<uint32_t>> id_planes;  ///< objectId
    std::map<std::string, std::string> attributes;     ///< text for the header: scene, version, ...
    glm::ivec2 first{0};  ///< where the planes begin in a picture that they are a part of
    glm::ivec2 frame{0};  ///< pixels of that picture; 0 for an image that is whole
};

/// The key of an image's attribute with the width of its pixels over their height, if that isn't 1.
/// Files have it as a number of their own.
inline constexpr const char* kPixelAspect = "pixelAspectRatio";

/// The width of an image's pixels over their height, by its attributes: 1 without kPixelAspect.
double pixel_aspect_in(const std::map<std::string, std::string>& attributes);

}  // namespace voxelume
