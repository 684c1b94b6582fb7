// SPDX-License-Identifier: Apache-2.0
// Reconstruction filters against their definitions, integrated number by number.
#include "runtime/scene/parts/reconstruction_filter.hpp"

#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <cmath>

#include "runtime/base/error.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/oracles/filter_weights.hpp"
#include "tests/scene/small_scene.hpp"

namespace voxelume {
namespace {

using testing::HasSubstr;

constexpr FilterShape kFilterShapes[] = {FilterShape::box, FilterShape::tent, FilterShape::gaussian,
                                         FilterShape::blackman_harris};

TEST(ReconstructionFilter, HasTheWeightsOfItsDefinition) {
    for (const FilterShape shape : kFilterShapes) {
        const ReconstructionFilter unit{shape, 1};
        const FilterRow& row = filter_row(unit);
        for (int i = 0; i <= 20; ++i) {
            const double x = i / 40.0;
            EXPECT_NEAR(row.weight_to(x), oracle::filter_weight(shape, -0.5, x) - 0.5, 1e-9)
                << row.name << " " << x;
        }
        double squares = 0;
        constexpr int kParts = 100000;
        for (int i = 0; i < kParts; ++i) {
            const double density = oracle::filter_density(shape, (i + 0.5) / kParts - 0.5);
            squares += density * density / kParts;
        }
        EXPECT_NEAR(row.equal_box, 1 / squares, 1e-4) << row.name;
    }
}

TEST(ReconstructionFilter, PlacesSamplesByTheShareOfTheWeightBelowThem) {
    for (const FilterShape shape : kFilterShapes)
        for (const double width : {0.3, 1.0, 2.5, 16.0}) {
            const ReconstructionFilter filter{shape, width};
            EXPECT_EQ(filter_offset(filter, 0.5), 0.0);
            for (int i = 0; i < 50; ++i) {
                const double share = i / 50.0, at = filter_offset(filter, share) / width;
                EXPECT_LE(std::abs(at), 0.5);
                EXPECT_NEAR(oracle::filter_weight(shape, -0.5, at), share, 1e-9) << int(shape);
                if (i > 0) {
                    EXPECT_NEAR(filter_offset(filter, 1 - share), -at * width, 1e-12);
                }
            }
        }
}

RenderSettings filter_settings(const std::string& keys) {
    return parse_scene(scene_with("\"render\": {" + keys + "},"), "room.json", {}).render;
}

TEST(ReconstructionFilter, IsABoxOfOnePixelUnlessTheSceneSaysOtherwise) {
    EXPECT_TRUE(filter_settings("").filter.is_pixel());
    EXPECT_TRUE(filter_settings(R"("filter": "box")").filter.is_pixel());
    const auto filter = [](const std::string& keys) { return filter_settings(keys).filter; };
    EXPECT_EQ(filter(R"("filter": "tent")"), (ReconstructionFilter{FilterShape::tent, 2}));
    EXPECT_EQ(filter(R"("filter": "gaussian")"), (ReconstructionFilter{FilterShape::gaussian, 3}));
    EXPECT_EQ(filter(R"("filter": "blackman-harris", "filter_width": 1.5)"),
              (ReconstructionFilter{FilterShape::blackman_harris, 1.5}));
    EXPECT_EQ(filter(R"("filter_width": 2)"), (ReconstructionFilter{FilterShape::box, 2}));
}

TEST(ReconstructionFilter, RefusesShapesAndWidthsThatItDoesNotHave) {
    const auto objection = [](const std::string& keys) -> std::string {
        try {
            filter_settings(keys);
        } catch (const Error& error) {
            return error.what();
        }
        return "no error";
    };
    EXPECT_THAT(objection(R"("filter": "blackman")"), HasSubstr("\"blackman-harris\""));
    EXPECT_THAT(objection(R"("filter_width": 0)"), HasSubstr("filter_width"));
    EXPECT_THAT(objection(R"("filter_width": 16.5)"), HasSubstr("16"));
}

TEST(ReconstructionFilter, WidensTheViewByWhatLiesOutsideOfTheImage) {
    Display display;
    display.half_angles = {0.6, 0.4};
    const ReconstructionFilter filter{FilterShape::tent, 5};
    // An image of 10 x 4 pixels shows 2 more on each side: 14 x 8.
    const Display pyramid = with_filter_margin(display, filter, {10, 4});
    EXPECT_NEAR(std::tan(pyramid.half_angles.x), 1.4 * std::tan(0.6), 1e-12);
    EXPECT_NEAR(std::tan(pyramid.half_angles.y), 2 * std::tan(0.4), 1e-12);
    display.shape = DisplayShape::box;
    display.half_size = {3, 2};
    EXPECT_EQ(with_filter_margin(display, filter, {10, 4}).half_size.y, 4);
    EXPECT_EQ(with_filter_margin(display, {FilterShape::tent, 0.5}, {10, 4}), display);
}

}  // namespace
}  // namespace voxelume
