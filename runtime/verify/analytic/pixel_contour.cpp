// SPDX-License-Identifier: Apache-2.0
#include "runtime/verify/analytic/pixel_contour.hpp"

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <glm/geometric.hpp>
#include <thread>

namespace voxelume {
namespace {

double distance_between(const PixelContour::Segment& segment, const glm::dvec2& p) {
    const glm::dvec2 along = segment.b - segment.a;
    const double square = glm::dot(along, along);
    const double share =
        square > 0 ? std::clamp(glm::dot(p - segment.a, along) / square, 0.0, 1.0) : 0.0;
    return glm::distance(p, segment.a + share * along);
}

/// The point between a and b where the side changes. One of the two is inside.
glm::dvec2 crossing(const std::function<bool(const glm::dvec2&)>& is_inside, glm::dvec2 a,
                    glm::dvec2 b) {
    constexpr int kHalvings = 30;
    const bool begins = is_inside(a);
    for (int i = 0; i < kHalvings; ++i) {
        const glm::dvec2 middle = (a + b) / 2.0;
        (is_inside(middle) == begins ? a : b) = middle;
    }
    return (a + b) / 2.0;
}

}  // namespace

double PixelContour::distance_to(const glm::dvec2& p) const {
    double nearest = INFINITY;
    for (const Segment& segment : segments)
        nearest = std::min(nearest, distance_between(segment, p));
    return nearest;
}

PixelContour contour_of(glm::ivec2 size, const std::vector<PixelSide>& sides,
                        const std::function<bool(const glm::dvec2&)>& is_inside) {
    PixelContour contour;
    const auto side_of = [&](const glm::ivec2& p) {
        return sides[size_t(p.y) * size_t(size.x) + size_t(p.x)];
    };
    for (int row = 0; row + 1 < size.y; ++row)
        for (int column = 0; column + 1 < size.x; ++column) {
            const std::array<glm::ivec2, 4> corners = {
                {{column, row}, {column + 1, row}, {column + 1, row + 1}, {column, row + 1}}};
            const auto is_unknown = [&](const glm::ivec2& p) {
                return side_of(p) == PixelSide::unknown;
            };
            if (std::ranges::any_of(corners, is_unknown)) continue;
            std::array<glm::dvec2, 4> ends;
            size_t count = 0;
            for (size_t i = 0; i < 4; ++i) {
                const glm::ivec2 a = corners[i], b = corners[(i + 1) % 4];
                if (side_of(a) != side_of(b))
                    ends[count++] = crossing(is_inside, glm::dvec2(a) + 0.5, glm::dvec2(b) + 0.5);
            }
            for (size_t i = 0; i + 1 < count; i += 2) {
                contour.segments.push_back({ends[i], ends[i + 1]});
                contour.length += glm::distance(ends[i], ends[i + 1]);
            }
        }
    return contour;
}

void ContourError::add(const glm::dvec2& center) {
    ++count_;
    max_ = std::max(max_, truth_.distance_to(center));
}

double ContourError::mean() const {
    return double(count_) / std::max(truth_.length, 1.0);
}

void for_rows(int rows, const std::function<void(int)>& work) {
    std::atomic<int> next = 0;
    const auto take = [&] {
        for (int row = next++; row < rows; row = next++) work(row);
    };
    std::vector<std::jthread> threads;
    for (unsigned i = 1; i < std::thread::hardware_concurrency(); ++i) threads.emplace_back(take);
    take();
}

}  // namespace voxelume
