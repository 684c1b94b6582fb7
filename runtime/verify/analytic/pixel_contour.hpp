// The border between two kinds of pixels of an ideal image, between the pixels' centres.
#pragma once

#include <cstdint>
#include <functional>
#include <glm/vec2.hpp>
#include <vector>

namespace voxelume {

/// What an ideal image shows at a pixel's centre.
enum class PixelSide : uint8_t {
    outside,
    inside,
    unknown  ///< neither: the border isn't followed there
};

/// A border as straight pieces, each within the square between four pixels' centres.
struct PixelContour {
    struct Segment {
        glm::dvec2 a, b;  ///< pixels from the upper left corner
    };
    std::vector<Segment> segments;
    double length = 0;  ///< pixels

    /// Pixels; infinite where there is no border at all.
    double distance_to(const glm::dvec2& p) const;
};

/// Follows the border. `is_inside` tells of any point of the image, in pixels, what `sides` tells
/// of the centres; only points between an inside and an outside pixel are asked for.
PixelContour contour_of(glm::ivec2 size, const std::vector<PixelSide>& sides,
                        const std::function<bool(const glm::dvec2&)>& is_inside);

/// How far the pixels of an image lie on the wrong side of a border.
class ContourError {
  public:
    explicit ContourError(const PixelContour& truth) : truth_(truth) {}

    /// Counts a pixel, by its centre, that is on the wrong side.
    void add(const glm::dvec2& center);

    /// Pixels: the area on the wrong side over the border's length.
    double mean() const;
    /// Pixels: the farthest centre from the border, 0 without any.
    double max() const { return max_; }

  private:
    const PixelContour& truth_;
    uint64_t count_ = 0;
    double max_ = 0;
};

/// Calls `work` with every row of an image, on all threads.
void for_rows(int rows, const std::function<void(int)>& work);

}  // namespace voxelume
