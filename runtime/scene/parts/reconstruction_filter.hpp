// SPDX-License-Identifier: Apache-2.0
// The distribution of samples around the middle of a pixel whose mean is the pixel's value.
//
// The density of samples replaces their weights: samples are dense where the filter is high. So all
// samples of a pixel count equally, and none is wasted. After Ernst, Stamminger & Greiner 2006,
// "Filter Importance Sampling".
#pragma once

#include <cstdint>
#include <glm/vec2.hpp>
#include <span>
#include <string_view>

#include "runtime/scene/parts/display_shape.hpp"
#include "runtime/scene/parts/value_row.hpp"

namespace voxelume {

enum class FilterShape : uint8_t { box, tent, gaussian, blackman_harris };

/// A filter is the product of its shape along x and along y.
struct ReconstructionFilter {
    FilterShape shape = FilterShape::box;
    double width = 1;  ///< pixels from one end to the other, in kFilterWidth

    /// True if a pixel is the mean over its own area.
    bool is_pixel() const { return shape == FilterShape::box && width == 1; }
    friend bool operator==(const ReconstructionFilter&, const ReconstructionFilter&) = default;
};

inline constexpr Range kFilterWidth{0, 16, true};

/// The properties of a shape, for filters with a width of 1.
struct FilterRow {
    std::string_view name;  ///< in scene files
    double default_width;   ///< pixels
    /// The part of the filter's weight between its middle and `x` in [0, 1/2].
    double (*weight_to)(double x);
    double equal_box;  ///< width of the box filter with the same reduction of noise: (∫f)² / ∫f²
};

/// The rows in the order of FilterShape.
std::span<const FilterRow> filter_rows();

const FilterRow& filter_row(const ReconstructionFilter& filter);

/// The position, in pixels from the filter's middle, below which `share`, in [0, 1), of the
/// filter's weight lies. It is exactly 0 for one half.
double filter_offset(const ReconstructionFilter& filter, double share);

/// The display that holds the sight rays of all samples: with filters, some samples of border
/// pixels lie outside of the image, which has `frame` pixels.
Display with_filter_margin(Display display, const ReconstructionFilter& filter, glm::ivec2 frame);

}  // namespace voxelume
