// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/volume_view.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <glm/common.hpp>
#include <glm/geometric.hpp>
#include <limits>
#include <numeric>

#include "runtime/image/view_canvas.hpp"
#include "runtime/image/volume_geometry.hpp"

namespace voxelume {
namespace {

constexpr double kPi = 3.141592653589793;
constexpr int kSlices = 8, kSliceColumns = 4;

using Corners = std::array<glm::dvec3, 8>;

/// The corners of a voxel in the observer's coordinates, metres.
Corners corners_of(const VolumeFrame& frame, const glm::ivec3& cell) {
    Corners corners;
    for (int i = 0; i < 8; ++i) {
        const glm::dvec3 at = glm::dvec3(cell) + glm::dvec3(i & 1, i >> 1 & 1, i >> 2);
        corners[size_t(i)] = frame.layout == VolumeLayout::lattice
                                 ? frame.origin + frame.edge * at
                                 : point_on_ray(frame, at, frame.display.near + frame.step * at.z);
    }
    return corners;
}

bool is_shown(const Volume& volume, size_t i) {
    return volume.opacities[i] > 0 && volume.kinds[i] != VoxelKind::unseen;
}

struct VolumeBox {
    glm::dvec3 low{std::numeric_limits<double>::infinity()};
    glm::dvec3 high{-std::numeric_limits<double>::infinity()};
    void add(const glm::dvec3& p) { low = glm::min(low, p), high = glm::max(high, p); }
};

/// Lines along the display's sides, in the observer's coordinates.
std::vector<std::vector<glm::dvec3>> outline_of(const VolumeFrame& frame) {
    constexpr int kPieces = 32;
    std::vector<std::vector<glm::dvec3>> lines;
    const glm::dvec3 size(frame.size);
    // Adds a line. `at` gives the voxel coordinates of its points, from 0 at its start to 1 at its
    // end.
    const auto add = [&](const auto& at) {
        std::vector<glm::dvec3>& line = lines.emplace_back();
        for (int i = 0; i <= kPieces; ++i) {
            const glm::dvec3 p = at(double(i) / kPieces);
            line.push_back(frame.layout == VolumeLayout::lattice
                               ? frame.origin + frame.edge * p
                               : point_on_ray(frame, p, frame.display.near + frame.step * p.z));
        }
    };
    const bool curved = frame.layout == VolumeLayout::rays && !depth_is_along_z(frame);
    if (!curved) {
        for (int axis = 0; axis < 3; ++axis)
            for (int corner = 0; corner < 4; ++corner)
                add([&](double t) {
                    glm::dvec3 p(0);
                    p[axis] = t * size[axis];
                    p[(axis + 1) % 3] = (corner & 1) * size[(axis + 1) % 3];
                    p[(axis + 2) % 3] = (corner >> 1) * size[(axis + 2) % 3];
                    return p;
                });
        return lines;
    }
    // A round image's outline is its rim. A ball has no rim; its equator is drawn instead.
    const bool is_round = shape_row(frame.display).image_is_round;
    const glm::dvec2 half = glm::dvec2(size) / 2.0;
    for (const double k : {0.0, size.z}) {
        add([&](double t) {
            const double angle = 2 * kPi * t;
            const glm::dvec2 rim = half + half * glm::dvec2(std::cos(angle), std::sin(angle));
            return is_round ? glm::dvec3(rim, k) : glm::dvec3(t * size.x, half.y, k);
        });
        add([&](double t) { return glm::dvec3(half.x, t * size.y, k); });
        if (is_round) add([&](double t) { return glm::dvec3(t * size.x, half.y, k); });
    }
    return lines;
}

/// A camera that looks at a sphere so that it fills the picture.
class SheetCamera {
  public:
    SheetCamera(const VolumeBox& extent, const ViewPoint& view, glm::ivec2 size) {
        const double radius = std::max(glm::length(extent.high - extent.low) / 2, 1e-9);
        const double distance = 3 * radius;
        ahead_ = {std::sin(view.around) * std::cos(view.above), -std::sin(view.above),
                  std::cos(view.around) * std::cos(view.above)};
        right_ = {-std::cos(view.around), 0, std::sin(view.around)};
        up_ = glm::cross(right_, ahead_);
        position_ = (extent.low + extent.high) / 2.0 - distance * ahead_;
        // This is the tangent to the sphere, with a little room around it.
        const double tangent = 1.04 * radius / std::sqrt(distance * distance - radius * radius);
        scale_ = 0.5 * std::min(size.x, size.y) / tangent;
        middle_ = glm::dvec2(size) / 2.0;
        min_depth_ = 0.05 * radius;
    }
    /// The position of a point in the picture, pixels from its top left, and its depth in metres.
    glm::dvec3 project(const glm::dvec3& p) const {
        const glm::dvec3 q = p - position_;
        const double depth = glm::dot(q, ahead_), by = scale_ / depth;
        return {middle_.x + glm::dot(q, right_) * by, middle_.y - glm::dot(q, up_) * by, depth};
    }
    bool sees(const glm::dvec3& projected) const { return projected.z > min_depth_; }
    double distance(const glm::dvec3& p) const { return glm::length(p - position_); }

  private:
    glm::dvec3 position_, right_, up_, ahead_;
    glm::dvec2 middle_;
    double scale_, min_depth_;
};

/// The indices of the voxels that show something, the farthest first.
std::vector<uint32_t> painting_order(const Volume& volume, const SheetCamera& camera) {
    std::vector<std::pair<float, uint32_t>> order;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        if (!is_shown(volume, i)) continue;
        const Corners corners = corners_of(volume.frame, cell_of(volume.frame, volume.indices[i]));
        const glm::dvec3 middle =
            std::accumulate(corners.begin(), corners.end(), glm::dvec3(0)) / 8.0;
        order.emplace_back(-float(camera.distance(middle)), uint32_t(i));
    }
    std::ranges::sort(order);
    std::vector<uint32_t> numbers;
    numbers.reserve(order.size());
    for (const auto& [distance, i] : order) numbers.push_back(i);
    return numbers;
}

VolumeBox box_of_volume(const Volume& volume) {
    VolumeBox extent;
    for (size_t i = 0; i < volume.indices.size(); ++i)
        if (is_shown(volume, i))
            for (const glm::dvec3& p :
                 corners_of(volume.frame, cell_of(volume.frame, volume.indices[i])))
                extent.add(p);
    if (extent.low.x > extent.high.x)
        for (const auto& line : outline_of(volume.frame))
            for (const glm::dvec3& p : line) extent.add(p);
    return extent;
}

/// The first and the last k with voxels that show something; all k if there are none.
std::pair<int, int> shown_depths(const Volume& volume) {
    int first = volume.frame.size.z, last = -1;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        if (!is_shown(volume, i)) continue;
        const int k = cell_of(volume.frame, volume.indices[i]).z;
        first = std::min(first, k), last = std::max(last, k);
    }
    if (last < 0) return {0, volume.frame.size.z - 1};
    return {first, last};
}

void paste(const Image& part, glm::ivec2 corner, Image& whole) {
    for (const auto& [name, values] : part.planes)
        for (int y = 0; y < part.height; ++y)
            std::copy_n(
                values.begin() + std::ptrdiff_t(y) * part.width, part.width,
                whole.planes[name].begin() + std::ptrdiff_t(y + corner.y) * whole.width + corner.x);
}

}  // namespace

Image view_volume(const Volume& volume, const ViewPoint& view, glm::ivec2 size) {
    ViewCanvas canvas(size);
    const SheetCamera camera(box_of_volume(volume), view, size);
    for (const auto& line : outline_of(volume.frame))
        for (size_t i = 1; i < line.size(); ++i) {
            const glm::dvec3 a = camera.project(line[i - 1]), b = camera.project(line[i]);
            if (camera.sees(a) && camera.sees(b)) canvas.draw_line(a, b);
        }
    for (const uint32_t i : painting_order(volume, camera)) {
        const Corners corners = corners_of(volume.frame, cell_of(volume.frame, volume.indices[i]));
        std::array<glm::dvec2, 8> points;
        std::ranges::transform(corners, points.begin(),
                               [&](const glm::dvec3& p) { return glm::dvec2(camera.project(p)); });
        canvas.cover_hull(points, volume.colors[i], volume.opacities[i]);
    }
    return canvas.image();
}

Image view_slices(const Volume& volume, int first, int end, glm::ivec2 size) {
    ViewCanvas canvas(size);
    const VolumeFrame& frame = volume.frame;
    const bool lattice = frame.layout == VolumeLayout::lattice;
    glm::dvec2 extent(frame.size);
    if (lattice) extent *= glm::dvec2(frame.edge);
    const double scale = std::min(size.x / extent.x, size.y / extent.y);
    const glm::dvec2 cell = scale * extent / glm::dvec2(frame.size);
    const glm::dvec2 corner = (glm::dvec2(size) - scale * extent) / 2.0;
    canvas.draw_frame(corner, corner + scale * extent);
    const uint64_t layer = uint64_t(frame.size.x) * uint64_t(frame.size.y);
    const auto from = std::ranges::lower_bound(volume.indices, layer * uint64_t(first));
    const auto to = std::ranges::lower_bound(volume.indices, layer * uint64_t(end));
    // Indices ascend with k, so the voxels behind come first in this order.
    for (auto index = to; index != from;) {
        const auto i = size_t(--index - volume.indices.begin());
        if (!is_shown(volume, i)) continue;
        glm::ivec3 v = cell_of(frame, *index);
        if (lattice) v.x = frame.size.x - 1 - v.x, v.y = frame.size.y - 1 - v.y;
        const glm::dvec2 at = corner + cell * glm::dvec2(v);
        canvas.cover_rectangle(at, at + cell, volume.colors[i], volume.opacities[i]);
    }
    return canvas.image();
}

Image view_sheet(const Volume& volume, const ViewPoint& view, glm::ivec2 size) {
    Image sheet = ViewCanvas(size).image();
    const int gap = std::max(1, size.x / 200), views = size.y * 3 / 5;
    const glm::ivec2 half(size.x / 2, views);
    const auto inside = [gap](glm::ivec2 box) { return glm::max(box - gap, glm::ivec2(1)); };
    paste(view_volume(volume, {}, inside(half)), {0, 0}, sheet);
    paste(view_volume(volume, view, inside(half)), {half.x, 0}, sheet);
    const auto [near, far] = shown_depths(volume);
    const int depths = far - near + 1;
    const glm::ivec2 panel(size.x / kSliceColumns, (size.y - views) / (kSlices / kSliceColumns));
    for (int i = 0; i < kSlices; ++i) {
        const int first = near + int(int64_t(depths) * i / kSlices);
        const int end = near + int(int64_t(depths) * (i + 1) / kSlices);
        paste(view_slices(volume, first, end, inside(panel)),
              {panel.x * (i % kSliceColumns), views + panel.y * (i / kSliceColumns)}, sheet);
    }
    return sheet;
}

}  // namespace voxelume
