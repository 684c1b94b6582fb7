// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/view_canvas.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>

namespace voxelume {
namespace {

constexpr int kSamples = 2;  ///< samples along each side of a pixel
constexpr glm::vec3 kBackground(0.010f, 0.012f, 0.016f), kOutline(0.05f, 0.055f, 0.065f);

bool turns_left(const glm::dvec2& a, const glm::dvec2& b, const glm::dvec2& c) {
    return (b.x - a.x) * (c.y - a.y) - (b.y - a.y) * (c.x - a.x) > 0;
}

/// Fills `hull` with the corners of the convex hull, in turn (Andrew's monotone chain).
std::vector<glm::dvec2>& hull_of(std::span<const glm::dvec2> points,
                                 std::vector<glm::dvec2>& hull) {
    std::vector<glm::dvec2> sorted(points.begin(), points.end());
    std::ranges::sort(sorted, [](const glm::dvec2& a, const glm::dvec2& b) {
        return a.x < b.x || (a.x == b.x && a.y < b.y);
    });
    hull.clear();
    for (int side = 0; side < 2; ++side) {
        const size_t first = hull.size();
        for (const glm::dvec2& p : sorted) {
            while (hull.size() >= first + 2 && !turns_left(hull[hull.size() - 2], hull.back(), p))
                hull.pop_back();
            hull.push_back(p);
        }
        hull.pop_back();
        std::ranges::reverse(sorted);
    }
    return hull;
}

}  // namespace

ViewCanvas::ViewCanvas(glm::ivec2 size)
    : size_(size * kSamples), samples_(size_t(size_.x) * size_t(size_.y), kBackground) {}

void ViewCanvas::cover_sample(glm::dvec2 at, const glm::vec3& color, float opacity) {
    const glm::dvec2 sample = glm::floor(at);
    if (sample.x < 0 || sample.y < 0 || sample.x >= size_.x || sample.y >= size_.y) return;
    glm::vec3& to = samples_[size_t(sample.y) * size_t(size_.x) + size_t(sample.x)];
    to = glm::mix(to, color, opacity);
}

/// Covers the samples of row y whose middles lie in [first, last). Returns whether there are any.
bool ViewCanvas::cover_span(int y, double first, double last, const glm::vec3& color,
                            float opacity) {
    const int begin = int(std::ceil(std::max(first, 0.0) - 0.5));
    const int end = int(std::ceil(std::min(last, double(size_.x)) - 0.5));
    for (int x = std::max(begin, 0); x < end; ++x) {
        glm::vec3& to = samples_[size_t(y) * size_t(size_.x) + size_t(x)];
        to = glm::mix(to, color, opacity);
    }
    return begin < end;
}

void ViewCanvas::cover_hull(std::span<const glm::dvec2> points, const glm::vec3& color,
                            float opacity) {
    std::vector<glm::dvec2> hull;
    hull_of(points, hull);
    glm::dvec2 middle(0);
    double top = std::numeric_limits<double>::infinity(), bottom = -top;
    for (glm::dvec2& p : hull) {
        p *= kSamples;
        middle += p / double(hull.size());
        top = std::min(top, p.y), bottom = std::max(bottom, p.y);
    }
    const int first = int(std::ceil(std::max(top, 0.0) - 0.5));
    const int end = int(std::ceil(std::min(bottom, double(size_.y)) - 0.5));
    bool covered = false;
    for (int y = std::max(first, 0); y < end; ++y) {
        double left = std::numeric_limits<double>::infinity(), right = -left;
        for (size_t i = 0; i < hull.size(); ++i) {
            const glm::dvec2 &a = hull[i], &b = hull[(i + 1) % hull.size()];
            if ((a.y <= y + 0.5) == (b.y <= y + 0.5)) continue;
            const double x = a.x + (b.x - a.x) * (y + 0.5 - a.y) / (b.y - a.y);
            left = std::min(left, x), right = std::max(right, x);
        }
        if (left < right) covered |= cover_span(y, left, right, color, opacity);
    }
    if (!covered) cover_sample(middle, color, opacity);
}

void ViewCanvas::cover_rectangle(glm::dvec2 low, glm::dvec2 high, const glm::vec3& color,
                                 float opacity) {
    low *= kSamples, high *= kSamples;
    for (int axis = 0; axis < 2; ++axis) {
        if (std::ceil(low[axis] - 0.5) < std::ceil(high[axis] - 0.5)) continue;
        // No sample's middle lies inside, so the nearest one is covered.
        low[axis] = std::floor(low[axis]) + 0.5;
        high[axis] = low[axis] + 0.5;
    }
    const int end = int(std::ceil(std::min(high.y, double(size_.y)) - 0.5));
    for (int y = std::max(int(std::ceil(low.y - 0.5)), 0); y < end; ++y)
        cover_span(y, low.x, high.x, color, opacity);
}

void ViewCanvas::draw_line(glm::dvec2 from, glm::dvec2 to) {
    constexpr double kMaxSteps = 1 << 16;
    from *= kSamples, to *= kSamples;
    const double steps = std::min(std::ceil(glm::length(to - from)) + 1, kMaxSteps);
    for (double i = 0; i <= steps; ++i) cover_sample(glm::mix(from, to, i / steps), kOutline, 1.0f);
}

void ViewCanvas::draw_frame(glm::dvec2 low, glm::dvec2 high) {
    low = glm::max(low, 0.0);
    high -= 1.0 / kSamples;  // the middle of the last sample inside
    draw_line(low, {high.x, low.y});
    draw_line(low, {low.x, high.y});
    draw_line(high, {high.x, low.y});
    draw_line(high, {low.x, high.y});
}

Image ViewCanvas::image() const {
    Image image{size_.x / kSamples, size_.y / kSamples, {}, {}, {}};
    const std::array<const char*, 3> names = {"R", "G", "B"};
    for (int c = 0; c < 3; ++c) {
        std::vector<float> plane(size_t(image.width) * size_t(image.height));
        for (size_t i = 0; i < plane.size(); ++i) {
            const size_t x = i % size_t(image.width) * kSamples;
            const size_t y = i / size_t(image.width) * kSamples;
            float sum = 0;
            for (size_t sy = 0; sy < kSamples; ++sy)
                for (size_t sx = 0; sx < kSamples; ++sx)
                    sum += samples_[(y + sy) * size_t(size_.x) + x + sx][c];
            plane[i] = sum / (kSamples * kSamples);
        }
        image.planes[names[size_t(c)]] = std::move(plane);
    }
    return image;
}

}  // namespace voxelume
