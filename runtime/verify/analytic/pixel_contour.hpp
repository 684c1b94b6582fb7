// SPDX-License-Identifier: Apache-2.0
// The border between two kinds of pixels of an ideal image, between the pixels' centres.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace voxelume {

/// The content of an ideal image at a pixel's centre.
enum class PixelSide : uint8_t {
    outside,
    inside,
    unknown  ///< neither: the border isn't followed there
};

/// A border of straight pieces, each within the square between four pixels' centres.
struct PixelContour {
    struct Segment {
        glm::dvec2 a, b;  ///< pixels from the upper left corner
    };
    std::vector<Segment> segments;
    double length = 0;  ///< pixels

    /// The distance from p to the border, pixels; infinite if there is no border.
    double distance_to(const glm::dvec2& p) const;
};

/// Follows the border. `is_inside` gives for any point of the image, in pixels, what `sides` gives
/// for the centres. It is called only for points between an inside and an outside pixel.
PixelContour contour_of(glm::ivec2 size, const std::vector<PixelSide>& sides,
                        const std::function<bool(const glm::dvec2&)>& is_inside);

/// Measures how far an image's pixels lie on the wrong side of a border.
class ContourError {
  public:
    explicit ContourError(const PixelContour& truth) : truth_(truth) {}

    /// Counts a pixel on the wrong side, by its centre.
    void add(const glm::dvec2& center);

    /// The area on the wrong side divided by the border's length, pixels.
    double mean() const;
    /// The distance from the border to the farthest centre, pixels; 0 if no pixel was counted.
    double max() const { return max_; }

  private:
    const PixelContour& truth_;
    uint64_t count_ = 0;
    double max_ = 0;
};

/// Calls `work` with every row of an image, on all threads.
void for_rows(int rows, const std::function<void(int)>& work);

}  // namespace voxelume
