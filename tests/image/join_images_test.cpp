// SPDX-License-Identifier: Apache-2.0
#include "runtime/image/join_images.hpp"

#include <gtest/gtest.h>

#include "runtime/base/error.hpp"

namespace voxelume {
namespace {

/// Rows of a picture of 2 x 5 pixels whose values are ten times the row plus the column.
Image rows(int first, int count) {
    std::vector<float> values;
    std::vector<uint32_t> ids;
    for (int row = first; row < first + count; ++row)
        for (int column = 0; column < 2; ++column) {
            values.push_back(float(10 * row + column));
            ids.push_back(uint32_t(100 + 10 * row + column));
        }
    Image image{2, count, {{"Z", values}}, {{"objectId", ids}}, {}};
    image.first = {0, first};
    image.frame = {2, 5};
    return image;
}

TEST(JoinImages, PartsInAnyOrderBecomeThePicture) {
    const Image image = join_images({rows(3, 2), rows(0, 2), rows(2, 1)});
    EXPECT_EQ(image.height, 5);
    EXPECT_EQ(image.frame, glm::ivec2(0));
    EXPECT_EQ(image.planes.at("Z"), rows(0, 5).planes.at("Z"));
    EXPECT_EQ(image.id_planes.at("objectId"), rows(0, 5).id_planes.at("objectId"));
}

TEST(JoinImages, PartsOfAPartStayInTheirPlace) {
    const Image image = join_images({rows(3, 2), rows(2, 1)});
    EXPECT_EQ(image.first, glm::ivec2(0, 2));
    EXPECT_EQ(image.frame, glm::ivec2(2, 5));
    EXPECT_EQ(image.planes.at("Z"), rows(2, 3).planes.at("Z"));
}

TEST(JoinImages, DoubledAndMissingRowsAreRefused) {
    EXPECT_THROW(join_images({rows(0, 2), rows(1, 2)}), Error);
    EXPECT_THROW(join_images({rows(0, 2), rows(3, 2)}), Error);
    EXPECT_THROW(join_images({}), Error);
}

TEST(JoinImages, PartsOfOtherPicturesAreRefused) {
    Image other = rows(2, 3);
    other.frame = {2, 6};
    EXPECT_THROW(join_images({rows(0, 2), other}), Error);
    other = rows(2, 3);
    other.planes["N.X"] = other.planes["Z"];
    EXPECT_THROW(join_images({rows(0, 2), other}), Error);
}

}  // namespace
}  // namespace voxelume
