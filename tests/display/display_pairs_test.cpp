// SPDX-License-Identifier: Apache-2.0
// Voxels of a lattice that show objects which lie in each other cover what the flat picture does:
// surfaces that rays don't see there show nothing.
#include <gtest/gtest.h>

#include "tests/display/lattice_cover.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

constexpr std::array kPairs = {
    CoverCase{"two balls", R"("m": {"shape": "sphere", "radius": 0.5, "surface": "SURFACE"})",
              R"({"model": "m", "material": "veil", "position": [-0.21, 0.05, 0.02],
"placement": "PLACEMENT"},
{"model": "m", "material": "lace", "position": [0.25, -0.1, 0.08], "placement": "PLACEMENT"})"},
    CoverCase{"ball in box",
              R"("m": {"shape": "sphere", "radius": 0.37, "surface": "SURFACE"},
"b": {"shape": "box", "size": [1.03, 0.97, 1.11], "surface": "SURFACE"})",
              R"({"model": "m", "material": "veil", "priority": 1, "placement": "PLACEMENT",
"position": [0.03, 0.02, -0.04]},
{"model": "b", "material": "lace", "turn": [20, 10, 5], "placement": "PLACEMENT"})"},
    CoverCase{"ball that a box hides",
              R"("m": {"shape": "sphere", "radius": 0.55, "surface": "SURFACE"},
"b": {"shape": "box", "size": [0.93, 0.87, 0.81], "surface": "SURFACE"})",
              R"({"model": "b", "material": "lace", "turn": [20, 10, 5], "placement": "PLACEMENT"},
{"model": "m", "material": "veil", "placement": "PLACEMENT", "position": [0.03, 0.02, -0.04]})"}};

constexpr std::array kKinds = {CoverKind{"exact", "world"}, CoverKind{"smooth", "world"},
                               CoverKind{"exact", "instance"}, CoverKind{"smooth", "instance"},
                               CoverKind{"cubes", "world"}};

std::string text_of(const CoverCase& c, const CoverKind& kind, int axis, const CoverDifference& d) {
    return fmt::format("{}, {} as {} along {}: mean {:.4f}, inside {:.4f}, {:.4f} far", c.name,
                       kind.surface, kind.placement, "xyz"[axis], d.mean(), d.largest_inside,
                       d.far_share());
}

TEST(Pairs, CoverAlongEachAxisWhatTheFlatPictureDoes) {
    size_t turn = 0;
    for (const CoverCase& c : kPairs)
        for (const CoverKind& kind : in_turn<CoverKind>({kKinds.begin(), kKinds.end()}, turn++))
            for (const int axis : in_turn<int>({0, 1, 2}, turn)) {
                const CoverDifference d = compare_along(c, kind, axis);
                SCOPED_TRACE(text_of(c, kind, axis, d));
                EXPECT_GT(d.pixels, 400);
                EXPECT_LT(d.mean(), 0.004);
                EXPECT_LT(d.largest_inside, 0.01);
                // Outlines: the picture has 64 samples a pixel, the lattice 64 lines a voxel, by
                // which 3 to 4 % of the pixels are off by more than 0.02; 10 to 26 % are where
                // surfaces that rays don't see count.
                EXPECT_LT(d.far_share(), 0.05);
            }
}

// A picture of 64 samples misses the opacity of its outlines as often as a lattice of 64 lines
// does.
TEST(Pairs, CoverOutlinesAsPreciselyAsPicturesOfAsManySamples) {
    const CoverCase& c = kPairs[0];
    for (const int axis : in_turn<int>({0, 1, 2}, 0)) {
        const Image fine = picture_along(c, kKinds[0], axis, 1024);
        const Image coarse = picture_along(c, kKinds[0], axis, 64);
        const auto& alpha = coarse.planes.at("A");
        const CoverDifference of_lattice = difference_of(covers_along(c, kKinds[0], axis), fine);
        const CoverDifference of_picture = difference_of({alpha.begin(), alpha.end()}, fine);
        fmt::print("{}; a picture of 64 samples {:.4f} far\n",
                   text_of(c, kKinds[0], axis, of_lattice), of_picture.far_share());
        EXPECT_LE(of_lattice.far_share(), 1.5 * of_picture.far_share());
    }
}

TEST(Pairs, ShowNoVoxelWithoutAnObject) {
    for (const CoverKind& kind : kKinds) {
        const Volume volume = cover_volume(cover_scene(
            kPairs[0], kind, kLookingAlong[2],
            box_keys(2, R"(, "voxels": [38, 36, 37], "layout": "lattice", "visibility": "all")"),
            {8, 8}));
        ASSERT_GT(volume.indices.size(), 1000u);
        for (size_t i = 0; i < volume.indices.size(); ++i) {
            ASSERT_NE(volume.objects[i], 0u) << kind.surface << " " << kind.placement << " " << i;
            ASSERT_LT(volume.opacities[i], 1.0f);
        }
    }
}

}  // namespace
}  // namespace voxelume
