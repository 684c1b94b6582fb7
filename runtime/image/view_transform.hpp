// SPDX-License-Identifier: Apache-2.0
// linear light -> the values that a picture stores for a screen.
#pragma once

#include <array>
#include <cstdint>
#include <glm/vec3.hpp>
#include <vector>

namespace voxelume {

/// The way in which light that is brighter than a screen becomes a colour of the screen.
enum class ViewTransform {
    srgb,    ///< what a screen shows, cut off at 1
    none,    ///< the light itself, cut off at 1: for programs that expect linear values
    filmic,  ///< a curve that bends like film's (Narkowicz 2015, a fit of ACES' reference), as sRGB
    agx      ///< 16.5 stops; bright colours fade to white (Sobotka 2022)
};

/// The codes of colours in pictures of 8 or 16 bits a channel. Equal colours have equal codes on
/// every machine.
class ColorCodes {
  public:
    ColorCodes(ViewTransform transform, int bits);

    /// The codes of linear Rec. 709. Infinite values count as very bright, NaN as 0.
    std::array<uint16_t, 3> operator()(const glm::vec3& linear) const;

    /// The code of opacity 1.
    uint16_t maximum() const { return maximum_; }

  private:
    uint16_t code(float value) const;
    uint16_t srgb(float linear) const;

    ViewTransform transform_;
    uint16_t maximum_;
    std::vector<float> thresholds_;
    /// For all floats that begin with the same bits: the thresholds that the least of them reaches.
    std::vector<uint32_t> starts_;
    uint32_t first_prefix_ = 0;  ///< the first bits of the smallest threshold
};

/// The value of AgX's curve, of contrast 2.4 around middle grey, at a position between its darkest
/// and brightest light, 0 to 1 in stops.
double agx_curve(double position);

}  // namespace voxelume
