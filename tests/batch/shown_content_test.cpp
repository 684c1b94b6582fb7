// SPDX-License-Identifier: Apache-2.0
// The report on a picture's contents: whether it shows objects, whether they are lit, or that
// neither is known.
#include "runtime/render/shown_content.hpp"

#include <gtest/gtest.h>

#include <limits>
#include <vector>

namespace voxelume {
namespace {

constexpr float kNothing = std::numeric_limits<float>::infinity();

Plane<float> all(float value) {
    return std::vector<float>(6, value);
}

/// An image of 3 x 2 pixels.
Image image_of(std::map<std::string, Plane<float>> planes) {
    Image image;
    image.width = 3;
    image.height = 2;
    image.planes = std::move(planes);
    return image;
}

void expect(const ShownContent& content, bool objects, bool light) {
    EXPECT_EQ(content.objects, objects);
    EXPECT_EQ(content.light, light);
}

}  // namespace

TEST(ShownContent, TakesObjectsFromDepthsOrElseFromCoverage) {
    const Plane<float> far = all(kNothing), dark = all(0);
    Plane<float> near = far, lit = dark;
    near[4] = 2.5f;
    lit[4] = 0.25f;
    expect(content_of(image_of({{"Z", far}})), false, true);
    expect(content_of(image_of({{"Z", near}})), true, true);
    expect(content_of(image_of({{"R", dark}, {"G", dark}, {"B", dark}, {"A", dark}})), false, true);
    expect(content_of(image_of({{"R", dark}, {"G", dark}, {"B", dark}, {"A", lit}})), true, false);
    expect(content_of(image_of({{"R", dark}, {"G", dark}, {"B", lit}, {"A", lit}})), true, true);
}

TEST(ShownContent, LeavesOutTheBackground) {
    const Plane<float> dark = all(0);
    Plane<float> near = all(kNothing), light = all(0.5f);
    near[1] = 1;
    light[1] = 0;
    const Image image =
        image_of({{"Z", near}, {"R", light}, {"G", dark}, {"B", dark}, {"A", dark}});
    expect(content_of(image), true, false);
}

TEST(ShownContent, OfAnImageWithoutDepthAndCoverageIsUnknown) {
    expect(content_of(image_of({{"N.X", all(0)}})), true, true);
}

TEST(ShownContent, OfAVolumeIsThatOfItsObjects) {
    Volume volume;
    volume.indices = {3, 8};
    volume.kinds = {VoxelKind::space, VoxelKind::space};
    volume.colors = {glm::vec3(1), glm::vec3(0, 0, 0.5f)};
    expect(content_of(volume), false, true);
    volume.kinds[1] = VoxelKind::object;
    expect(content_of(volume), true, true);
    volume.colors[1] = glm::vec3(0);
    expect(content_of(volume), true, false);
}

}  // namespace voxelume
