// SPDX-License-Identifier: Apache-2.0
// Splines between keys stay within what their values may be.
#include <gmock/gmock.h>

#include <algorithm>

#include "runtime/scene/scene.hpp"
#include "runtime/scene/track_values.hpp"

namespace voxelume {
namespace {

/// A track of one number, whose slopes carry it far below and above its keys.
Track spline_of(const ValueReference& value, double first, double second) {
    Track track;
    track.value = value;
    track.keys = {Interpolation::spline, {1, 5, 9}, {first, second, first}, 1};
    track.keys.in = {0, 50, -50};
    track.keys.out = {-50, 50, 0};
    return track;
}

template <class Rows>
auto row(const Rows& rows, std::string_view key) {
    return find_row(rows, key);
}

}  // namespace

TEST(TrackValues, OfSplinesStayInTheValuesRange) {
    const Track color = spline_of(row(material_rows(), "color"), 0.25, 0.75);
    double min = 1, max = 0;
    for (double frame = 1; frame <= 9; frame += 0.125) {
        const double value = values_of(color, frame)[0];
        min = std::min(min, value), max = std::max(max, value);
    }
    EXPECT_EQ(min, 0);
    EXPECT_EQ(max, 1);
    EXPECT_EQ(values_of(color, 5)[0], 0.75);
}

TEST(TrackValues, OfOpenRangesStopAtTheKeys) {
    const Track radius = spline_of(row(solid_rows(), "radius"), 0.25, 0.75);
    for (double frame = 1; frame <= 9; frame += 0.125)
        ASSERT_GT(values_of(radius, frame)[0], 0) << frame;
}

TEST(TrackValues, AreNumbersWhateverTheSlopes) {
    Track track = spline_of(row(light_rows(), "intensity"), 1, 2);
    track.keys.out = {1e308, -1e308, 0};
    track.keys.in = {0, 1e308, 1e308};
    for (double frame = 1; frame <= 9; frame += 0.125) {
        const double value = values_of(track, frame)[0];
        ASSERT_TRUE(value >= 0 && value <= kMaxLength) << value;
    }
}

}  // namespace voxelume
