// SPDX-License-Identifier: Apache-2.0
// How far around the middle of a pixel, and with what weights, samples make its value.
//
// The weights are those of where samples lie: many where the filter is high, few where it is low.
// So all samples of a pixel count alike, and none is lost. After Ernst, Stamminger & Greiner 2006,
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

    /// True if a pixel is the mean of what lies in it.
    bool is_pixel() const { return shape == FilterShape::box && width == 1; }
    friend bool operator==(const ReconstructionFilter&, const ReconstructionFilter&) = default;
};

inline constexpr Range kFilterWidth{0, 16, true};

/// What is known of a shape, for filters that are 1 wide.
struct FilterRow {
    std::string_view name;  ///< in scene files
    double default_width;   ///< pixels
    /// The share of the filter's weight between its middle and `x` in [0, 1/2].
    double (*weight_to)(double x);
    double equal_box;  ///< the width of the box that lessens noise as much: (∫f)² / ∫f²
};

/// In the order of FilterShape.
std::span<const FilterRow> filter_rows();

const FilterRow& filter_row(const ReconstructionFilter& filter);

/// Where the filter has the share `share`, in [0, 1), of its weight on the lower side: pixels from
/// its middle. It is exactly 0 for one half.
double filter_offset(const ReconstructionFilter& filter, double share);

/// The display whose sight rays are those of all samples: some of the pixels at an image's border
/// lie outside of the image, which has `frame` pixels.
Display with_filter_margin(Display display, const ReconstructionFilter& filter, glm::ivec2 frame);

}  // namespace voxelume
