// SPDX-License-Identifier: Apache-2.0
// Voxels of a lattice whose surfaces let light through, laid over one another along sight lines,
// cover as much as the flat picture of the same objects does.
#include <gtest/gtest.h>

#include <algorithm>

#include "tests/display/lattice_cover.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

constexpr std::array kCoverCases = {
    CoverCase{"sphere", R"("m": {"shape": "sphere", "radius": 0.63, "surface": "SURFACE"})",
              R"({"model": "m", "material": "veil"})"},
    CoverCase{"slab", R"("m": {"shape": "box", "size": [1.13, 0.33, 0.87], "surface": "SURFACE"})",
              R"({"model": "m", "material": "veil"})"},
    CoverCase{"plate", R"("m": {"shape": "box", "size": [1.1, 0.24, 0.9], "surface": "SURFACE"})",
              R"({"model": "m", "material": "veil", "turn": [35, 25, 15]})"}};

/// The coverage of a lattice along a ray from the observer, over all voxels that the ray passes.
double cover_of_ray(const VolumeFrame& frame, const std::vector<float>& dense,
                    const glm::dvec3& way) {
    const glm::dvec3 start = -frame.origin / frame.edge, along = way / frame.edge;
    std::vector<double> sides;  // where the ray comes to the sides of voxels
    for (int axis = 0; axis < 3; ++axis)
        for (int side = 0; side <= frame.size[axis]; ++side) {
            const double at = (side - start[axis]) / along[axis];
            if (at > 0) sides.push_back(at);
        }
    std::ranges::sort(sides);
    double clear = 1;
    for (size_t i = 1; i < sides.size(); ++i) {
        const glm::ivec3 cell(glm::floor(start + along * (0.5 * (sides[i - 1] + sides[i]))));
        if (glm::any(glm::lessThan(cell, glm::ivec3(0))) ||
            glm::any(glm::greaterThanEqual(cell, frame.size)))
            continue;
        clear *=
            1 - double(dense[size_t(cell.x + frame.size.x * (cell.y + frame.size.y * cell.z))]);
    }
    return 1 - clear;
}

/// From the corner of a lattice, so that sight lines lead through it from corner to corner.
CoverDifference compare_from_corner(const CoverCase& c, const char* surface) {
    constexpr int kPixels = 96;
    const char* observer = R"("position": [-1.5, -1.5, -1.5], "turn": [0, 0, 0])";
    const std::string keys = R"("shape": "pyramid", "angles": [110, 110], "far": 2.6)";
    const Volume volume = cover_volume(
        cover_scene(c, {surface}, observer,
                    keys + R"(, "voxels": [297, 297, 104], "layout": "lattice")", {8, 8}));
    const std::vector<float> dense = dense_opacities(volume);
    RenderReport report;
    const Image picture = render(
        shared_device(), cover_scene(c, {surface}, observer, keys, {kPixels, kPixels}), report);
    CoverDifference result;
    const double slope = std::tan(55 * M_PI / 180);
    for (int v = 0; v < kPixels; ++v)
        for (int u = 0; u < kPixels; ++u) {
            const double x = slope * (2.0 * u + 1 - kPixels) / kPixels;
            const double y = slope * (2.0 * v + 1 - kPixels) / kPixels;
            const double alpha = double(picture.planes.at("A")[size_t(v * kPixels + u)]);
            if (alpha > 0) result.add(cover_of_ray(volume.frame, dense, {-x, -y, 1}), alpha, false);
        }
    return result;
}

/// A test's message about a difference.
std::string text_of(const char* surface, const CoverCase& c, const CoverDifference& d) {
    return fmt::format("{} {}: mean {:.4f}, inside {:.4f} at most", surface, c.name, d.mean(),
                       d.largest_inside);
}

// Outlines within a voxel's side leave differences: smooth objects have more of them, as two lines
// a voxel may meet the rounding of their edges.
TEST(Covering, AlongEachAxisIsThatOfTheFlatPicture) {
    size_t turn = 0;
    for (const auto& [surface, limit] :
         {std::pair{"exact", 0.02}, {"smooth", 0.05}, {"cubes", 0.002}}) {
        for (const CoverCase& c : kCoverCases)
            for (const int axis : in_turn<int>({0, 1, 2}, turn++)) {
                const CoverDifference d = compare_along(c, {surface}, axis);
                SCOPED_TRACE(fmt::format("along {}: {}", "xyz"[axis], text_of(surface, c, d)));
                EXPECT_GT(d.pixels, 400);
                EXPECT_LT(d.mean(), limit);
                EXPECT_LT(d.largest_inside, 0.002);
            }
        ++turn;  // the next surface has other axes
    }
}

// Rays pass few voxels from corner to corner and many next to corners, so their coverage is right
// only on average.
TEST(Covering, AlongTheObserversDiagonalSightLinesIsThatOfTheFlatPictureOnAverage) {
    size_t turn = 0;
    for (const auto& [surface, limit] :
         {std::pair{"exact", 0.02}, {"smooth", 0.02}, {"cubes", 0.03}})
        for (const CoverCase& c :
             in_turn<CoverCase>({kCoverCases.begin(), kCoverCases.end()}, turn++)) {
            const CoverDifference d = compare_from_corner(c, surface);
            SCOPED_TRACE(text_of(surface, c, d));
            EXPECT_GT(d.pixels, 400);
            EXPECT_LT(d.mean(), limit);
        }
}

}  // namespace
}  // namespace voxelume
