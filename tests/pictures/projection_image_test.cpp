// SPDX-License-Identifier: Apache-2.0
// Orthographic pictures against exact coordinates, and panoramas against the directions of their
// pixels.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <cmath>
#include <glm/geometric.hpp>
#include <numbers>

#include "tests/oracles/image_hash.hpp"
#include "tests/pictures/light/box_scene.hpp"

namespace voxelume {
namespace {

struct PlacedBox {
    glm::dvec3 middle, size;
};

/// A scene of boxes in a world from -4 to 4, seen by the observer given.
Scene boxes_seen(const std::vector<PlacedBox>& boxes, const std::string& observer,
                 const std::string& surface, glm::ivec2 size) {
    const std::string kind =
        surface == "cubes" ? R"("cubes", "set": "solid")" : '"' + surface + '"';
    std::string models, objects;
    for (size_t i = 0; i < boxes.size(); ++i) {
        const auto& [m, s] = boxes[i];
        models += fmt::format(R"({}"b{}": {{"shape": "box", "size": [{}, {}, {}], "surface": {}}})",
                              i > 0 ? ", " : "", i, s.x, s.y, s.z, kind);
        objects += fmt::format(R"({}{{"model": "b{}", "position": [{}, {}, {}]}})",
                               i > 0 ? ", " : "", i, m.x, m.y, m.z);
    }
    return scene_of(fmt::format(
        R"({{"voxelume": 1, "world": {{"voxel_size": 0.125, "ambient": [1, 1, 1],
             "bounds": {{"min": [-4, -4, -4], "max": [4, 4, 4]}}}},
             "models": {{{}}}, "objects": [{}], "lights": [], "observer": {{{}}},
             "render": {{"size": [{}, {}]}}}})",
        models, objects, observer, size.x, size.y));
}

/// A grid of 3 x 2 boxes at six depths along +X, whose sides lie on the world's voxels.
std::vector<PlacedBox> grid_of_boxes() {
    std::vector<PlacedBox> boxes;
    for (int i = 0; i < 6; ++i)
        boxes.push_back({{-2 + 0.75 * i, 1.5 - 2.5 * (i / 3), -2.25 + 2.25 * (i % 3)},
                         {0.5, 1 + 0.25 * (i % 2), 0.75 + 0.25 * (i % 3)}});
    return boxes;
}

TEST(OrthographicPictures, ShowAGridOfBoxesWhereItsCoordinatesAre) {
    const std::vector<PlacedBox> boxes = grid_of_boxes();
    constexpr int kColumns = 41, kRows = 29;
    for (const char* surface : {"cubes", "exact"}) {
        // Looking along +X with Y up, the image's right is +Z. 6.15 m are 41 pixels of 0.15 m.
        const Rendered r =
            rendered(boxes_seen(boxes,
                                R"("position": [-3.5, 0.13, 0.06], "look_at": [0, 0.13, 0.06],
                          "projection": "orthographic", "width": 6.15)",
                                surface, {kColumns, kRows}));
        int shown = 0;
        for (int row = 0; row < kRows; ++row)
            for (int column = 0; column < kColumns; ++column) {
                const double y = 0.13 + 0.15 * (kRows / 2.0 - row - 0.5);
                const double z = 0.06 + 0.15 * (column + 0.5 - kColumns / 2.0);
                unsigned object = 0;
                for (size_t i = 0; i < boxes.size(); ++i)
                    if (std::abs(y - boxes[i].middle.y) < boxes[i].size.y / 2 &&
                        std::abs(z - boxes[i].middle.z) < boxes[i].size.z / 2)
                        object = unsigned(i) + 1;
                const size_t at = size_t(row * kColumns + column);
                ASSERT_EQ(r.image.id_planes.at("objectId")[at], object) << column << "," << row;
                if (object == 0) continue;
                ++shown;
                const double x = boxes[object - 1].middle.x - 0.25;
                ASSERT_NEAR(r.at("Z", column, row), x + 3.5, 1e-5) << "the depth along the view";
                ASSERT_NEAR(r.at("P.X", column, row), x, 1e-5);
                ASSERT_NEAR(r.at("P.Y", column, row), y, 1e-5);
                ASSERT_NEAR(r.at("P.Z", column, row), z, 1e-5);
                ASSERT_EQ(r.at("N.X", column, row), -1.0f);
            }
        EXPECT_GT(shown, 200);
    }
}

TEST(OrthographicPictures, HaveTheBitsOfADisplayThatIsABox) {
    const auto seen = [](const std::string& members) {
        return oracle::image_hash(
            rendered(boxes_seen(grid_of_boxes(),
                                R"("position": [-3, 2, -3], "look_at": [0, 0, 0], )" + members,
                                "exact", {40, 20}))
                .image);
    };
    const double end = std::sqrt(49.0 + 36.0 + 49.0);
    EXPECT_EQ(seen(R"("projection": "orthographic", "height": 4)"),
              seen(fmt::format(R"("display": {{"shape": "box", "size": [8, 4, {:.17g}]}})", end)));
}

TEST(PanoramicPictures, LookAroundByLongitudeAndLatitude) {
    // Six boxes are the walls of a room of 5 x 4 x 6 m around an observer off its middle.
    const glm::dvec3 half(2.5, 2, 3), eye(0.4, -0.3, 0.7);
    std::vector<PlacedBox> walls;
    for (int axis = 0; axis < 3; ++axis)
        for (const double side : {-1, 1}) {
            PlacedBox wall{glm::dvec3(0), 2.0 * half + 0.5};
            wall.middle[axis] = side * (half[axis] + 0.25);
            wall.size[axis] = 0.5;
            walls.push_back(wall);
        }
    constexpr int kColumns = 48, kRows = 24;
    // The middle of the image is the direction of Z_E: here -X. Y stays up, and right is -Z.
    const Rendered r =
        rendered(boxes_seen(walls,
                            R"("position": [0.4, -0.3, 0.7], "look_at": [-1, -0.3, 0.7],
                      "projection": "panoramic")",
                            "exact", {kColumns, kRows}));
    for (int row = 0; row < kRows; ++row)
        for (int column = 0; column < kColumns; ++column) {
            const double longitude = 2 * std::numbers::pi * ((column + 0.5) / kColumns - 0.5);
            const double latitude = std::numbers::pi * (0.5 - (row + 0.5) / kRows);
            const glm::dvec3 direction(-std::cos(latitude) * std::cos(longitude),
                                       std::sin(latitude),
                                       -std::cos(latitude) * std::sin(longitude));
            double distance = INFINITY;
            for (int axis = 0; axis < 3; ++axis)
                distance =
                    std::min(distance, (std::copysign(half[axis], direction[axis]) - eye[axis]) /
                                           direction[axis]);
            ASSERT_NEAR(r.at("Z", column, row), distance, 2e-5) << column << "," << row;
            const glm::dvec3 point = eye + distance * direction;
            ASSERT_NEAR(r.at("P.X", column, row), point.x, 2e-5) << column << "," << row;
            ASSERT_NEAR(r.at("P.Y", column, row), point.y, 2e-5) << column << "," << row;
            ASSERT_NEAR(r.at("P.Z", column, row), point.z, 2e-5) << column << "," << row;
            ASSERT_EQ(r.at("A", column, row), 1.0f);
        }
}

}  // namespace
}  // namespace voxelume
