// SPDX-License-Identifier: Apache-2.0
// Pictures by reconstruction filters against the filters' integrals over what is seen.
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/stages/light/footprint.hpp"
#include "tests/oracles/filter_weights.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/box_scene.hpp"

namespace voxelume {
namespace {

constexpr int kFilterColumns = 19, kFilterRows = 13;  // the box's edges lie inside of pixels

Scene filtered_scene(FilterShape shape, double width, int samples) {
    Scene scene = scene_of(box_scene("exact", ""));
    scene.render.size = {kFilterColumns, kFilterRows};
    scene.render.filter = {shape, width};
    scene.render.samples = samples;
    return scene;
}

/// The filter's integral over what a side of the box covers, from `low` to `high` in pixels, of the
/// pixel in this column or row.
double weight_on_box(const ReconstructionFilter& filter, int pixel, double low, double high) {
    const double middle = pixel + 0.5;
    return oracle::filter_weight(filter.shape, (low - middle) / filter.width,
                                 (high - middle) / filter.width);
}

/// The largest difference of a picture's coverage from the filter's integral over the box.
double filter_error(const Scene& scene) {
    const Rendered r = rendered(scene);
    const ReconstructionFilter& filter = scene.render.filter;
    double largest = 0;
    for (int y = 0; y < kFilterRows; ++y)
        for (int x = 0; x < kFilterColumns; ++x) {
            // The box covers x 0.4..-0.3 of 0.8..-0.8, and y 0.2..-0.3 of 0.6..-0.6.
            const double expected =
                weight_on_box(filter, x, 0.4 / 1.6 * kFilterColumns, 1.1 / 1.6 * kFilterColumns) *
                weight_on_box(filter, y, 0.4 / 1.2 * kFilterRows, 0.9 / 1.2 * kFilterRows);
            largest = std::max(largest, std::abs(double(r.at("A", x, y)) - expected));
        }
    return largest;
}

class FilteredPictures : public testing::TestWithParam<ReconstructionFilter> {};

TEST_P(FilteredPictures, ComeToTheFiltersIntegralOverWhatIsSeen) {
    const auto [shape, width] = GetParam();
    const double few = filter_error(filtered_scene(shape, width, 16));
    const double many = filter_error(filtered_scene(shape, width, 256));
    const double most = filter_error(filtered_scene(shape, width, 2048));
    EXPECT_LT(few, 0.2);
    EXPECT_LT(many, 0.3 * few);
    EXPECT_LT(most, 0.006);
}

TEST_P(FilteredPictures, OfPartsAreThePartsOfThePicture) {
    Scene scene = filtered_scene(GetParam().shape, GetParam().width, 8);
    const Rendered whole = rendered(scene);
    crop(scene, {5, 3}, {9, 6});
    const Rendered part = rendered(scene);
    for (int y = 0; y < 6; ++y)
        for (int x = 0; x < 9; ++x)
            for (const char* plane : {"R", "A", "Z"})
                ASSERT_EQ(part.at(plane, x, y), whole.at(plane, x + 5, y + 3)) << x << "," << y;
}

INSTANTIATE_TEST_SUITE_P(Filters, FilteredPictures,
                         testing::Values(ReconstructionFilter{FilterShape::box, 1},
                                         ReconstructionFilter{FilterShape::box, 2.5},
                                         ReconstructionFilter{FilterShape::tent, 2},
                                         ReconstructionFilter{FilterShape::gaussian, 3},
                                         ReconstructionFilter{FilterShape::blackman_harris, 1.5},
                                         ReconstructionFilter{FilterShape::blackman_harris, 4}));

TEST(FilteredPictures, OfOneSampleAreThoseOfPixelsMiddles) {
    const Rendered box = rendered(filtered_scene(FilterShape::box, 1, 1));
    const Rendered wide = rendered(filtered_scene(FilterShape::gaussian, 3, 1));
    EXPECT_EQ(oracle::image_hash(box.image), oracle::image_hash(wide.image));
}

TEST(FilteredPictures, BlurTexturesByWhatSamplesTogetherDoNotCover) {
    const GridFrame world{{-1, -1, -1}, {0.1, 0.1, 0.1}, {20, 20, 20}};
    const Footprint box = footprint_of(filtered_scene(FilterShape::box, 1, 16), world);
    const Footprint bell = footprint_of(filtered_scene(FilterShape::gaussian, 3, 16), world);
    EXPECT_GT(box.half_columns, 0);
    EXPECT_EQ(bell.half_columns, 0) << "samples outside of their pixel have no cells in it";
    EXPECT_NEAR(bell.width / box.width, 3 * 0.57449, 1e-5);
    EXPECT_NEAR(bell.across.x, 1.6 / kFilterColumns / 4 * 3 * 0.57449, 1e-6);
}

}  // namespace
}  // namespace voxelume
