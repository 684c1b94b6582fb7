// SPDX-License-Identifier: Apache-2.0
// The canvas on which views of volumes are painted, from back to front, with four samples a pixel.
#pragma once

#include <glm/vec2.hpp>
#include <glm/vec3.hpp>
#include <span>
#include <vector>

#include "runtime/image/image.hpp"

namespace voxelume {

/// Coordinates are pixels from the top left; colours are linear.
class ViewCanvas {
  public:
    explicit ViewCanvas(glm::ivec2 size);

    /// Covers the convex hull of some points. A hull smaller than a sample still covers one.
    void cover_hull(std::span<const glm::dvec2> points, const glm::vec3& color, float opacity);
    void cover_rectangle(glm::dvec2 low, glm::dvec2 high, const glm::vec3& color, float opacity);

    /// Draws a thin line, or the four lines of a rectangle, in the colour of outlines.
    void draw_line(glm::dvec2 from, glm::dvec2 to);
    void draw_frame(glm::dvec2 low, glm::dvec2 high);

    /// The picture so far, as the planes R, G, B.
    Image image() const;

  private:
    bool cover_span(int y, double first, double last, const glm::vec3& color, float opacity);
    void cover_sample(glm::dvec2 at, const glm::vec3& color, float opacity);

    glm::ivec2 size_;  ///< in samples
    std::vector<glm::vec3> samples_;
};

}  // namespace voxelume
