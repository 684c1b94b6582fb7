// SPDX-License-Identifier: Apache-2.0
// Voxels of a lattice whose surfaces let light through, laid over one another along sight lines,
// cover as much as the flat picture of the same objects does.
#include <gtest/gtest.h>

#include <algorithm>
#include <glm/vec2.hpp>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/render/renderer.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

constexpr double kOpacity = 0.4;

struct CoverCase {
    const char* name;
    const char* model;  ///< keys of it
    const char* turn;
};

constexpr std::array kCoverCases = {
    CoverCase{"sphere", R"("shape": "sphere", "radius": 0.63)", "[0, 0, 0]"},
    CoverCase{"slab", R"("shape": "box", "size": [1.13, 0.33, 0.87])", "[0, 0, 0]"},
    CoverCase{"plate", R"("shape": "box", "size": [1.1, 0.24, 0.9])", "[35, 25, 15]"}};

/// The object around the origin, as an observer sees it. `display` has its keys.
Scene cover_scene(const CoverCase& c, const char* surface, const std::string& observer,
                  const std::string& display, glm::ivec2 size) {
    return parsed(fmt::format(R"({{"voxelume": 1,
"world": {{"voxel_size": 0.05, "bounds": {{"min": [-1, -0.9, -0.95], "max": [1.1, 1, 0.9]}},
          "ambient": [1, 1, 1]}},
"materials": {{"veil": {{"color": [0.5, 0.7, 0.9], "opacity": {}}}}},
"models": {{"m": {{{}, "surface": "{}"}}}},
"objects": [{{"model": "m", "material": "veil", "turn": {}}}],
"observer": {{{}, "display": {{{}}}}},
"render": {{"size": [{}, {}], "samples": 16, "depth": 1}}}})",
                              kOpacity, c.model, surface, c.turn, observer, display, size.x,
                              size.y));
}

/// How far what voxels cover together is from what the flat picture's pixels cover.
struct CoverDifference {
    double sum = 0, largest_inside = 0;  ///< inside: where no outline is
    int pixels = 0;

    void add(double voxels, double picture, bool is_inside) {
        sum += voxels - picture;
        ++pixels;
        if (is_inside) largest_inside = std::max(largest_inside, std::abs(voxels - picture));
    }
    double mean() const { return std::abs(sum) / pixels; }
};

/// True if all pixels next to one have its opacity, so that no outline runs through it.
bool is_even(const Image& picture, int u, int v) {
    const auto& alpha = picture.planes.at("A");
    for (int y = std::max(v - 1, 0); y <= std::min(v + 1, picture.height - 1); ++y)
        for (int x = std::max(u - 1, 0); x <= std::min(u + 1, picture.width - 1); ++x)
            if (std::abs(alpha[size_t(y * picture.width + x)] -
                         alpha[size_t(v * picture.width + u)]) > 1e-3f)
                return false;
    return true;
}

/// The opacity of each voxel of a lattice.
std::vector<float> dense_opacities(const Volume& volume) {
    std::vector<float> dense(voxel_count(volume.frame), 0.0f);
    for (size_t i = 0; i < volume.indices.size(); ++i)
        dense[volume.indices[i]] = volume.opacities[i];
    return dense;
}

/// What a lattice covers along the lines of the middle of its columns along `axis`.
double cover_of_column(const VolumeFrame& frame, const std::vector<float>& dense, glm::ivec3 cell,
                       int axis) {
    double clear = 1;
    for (cell[axis] = 0; cell[axis] < frame.size[axis]; ++cell[axis])
        clear *=
            1 - double(dense[size_t(cell.x + frame.size.x * (cell.y + frame.size.y * cell.z))]);
    return 1 - clear;
}

constexpr glm::ivec3 kSize{76, 72, 74};
constexpr glm::dvec3 kEdges{1.9, 1.8, 1.85};  // of the box around the origin

/// Observers that look along x, y and z of the world, with boxes around the same space.
constexpr std::array kLookingAlong = {R"("position": [-1.25, 0, 0], "turn": [90, 0, 0])",
                                      R"("position": [0, -1.2, 0], "turn": [0, -90, 0])",
                                      R"("position": [0, 0, -1.225], "turn": [0, 0, 0])"};

std::string box_keys(int axis, const std::string& more) {
    const glm::dvec3 size = axis == 0   ? glm::dvec3(kEdges.z, kEdges.y, kEdges.x)
                            : axis == 1 ? glm::dvec3(kEdges.x, kEdges.z, kEdges.y)
                                        : kEdges;
    return fmt::format(R"("shape": "box", "size": [{}, {}, {}], "near": 0.3{})", size.x, size.y,
                       size.z, more);
}

CoverDifference compare_along(const CoverCase& c, const char* surface, int axis) {
    const std::array names = {"x", "y", "z"};
    const std::string lattice = fmt::format(
        R"(, "voxels": [{}, {}, {}], "layout": "lattice", "visibility": "all", "seen_along": "{}")",
        kSize.x, kSize.y, kSize.z, names[size_t(axis)]);
    const Volume volume =
        volume_of(cover_scene(c, surface, kLookingAlong[2], box_keys(2, lattice), {8, 8}));
    const std::vector<float> dense = dense_opacities(volume);
    const int right = axis == 0 ? 2 : 0, down = axis == 1 ? 2 : 1;
    RenderReport report;
    const Image picture = render(shared_device(),
                                 cover_scene(c, surface, kLookingAlong[size_t(axis)],
                                             box_keys(axis, ""), {kSize[right], kSize[down]}),
                                 report);
    CoverDifference result;
    for (int v = 0; v < picture.height; ++v)
        for (int u = 0; u < picture.width; ++u) {
            // Image right is -X_E, which is +Z for the first observer and -X for the others; down
            // is -Y_E, which is +Z for the second and -Y for the others.
            glm::ivec3 cell(0);
            cell[right] = axis == 0 ? u : picture.width - 1 - u;
            cell[down] = axis == 1 ? v : picture.height - 1 - v;
            const double alpha = double(picture.planes.at("A")[size_t(v * picture.width + u)]);
            const double covered = cover_of_column(volume.frame, dense, cell, axis);
            if (alpha > 0 || covered > 0)
                result.add(covered, alpha, alpha > 0 && is_even(picture, u, v));
        }
    return result;
}

/// What a lattice covers along a ray from the observer, by all voxels that it passes.
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
    const Volume volume = volume_of(
        cover_scene(c, surface, observer,
                    keys + R"(, "voxels": [297, 297, 104], "layout": "lattice")", {8, 8}));
    const std::vector<float> dense = dense_opacities(volume);
    RenderReport report;
    const Image picture = render(
        shared_device(), cover_scene(c, surface, observer, keys, {kPixels, kPixels}), report);
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

/// What a test says of a difference.
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
                const CoverDifference d = compare_along(c, surface, axis);
                SCOPED_TRACE(fmt::format("along {}: {}", "xyz"[axis], text_of(surface, c, d)));
                EXPECT_GT(d.pixels, 400);
                EXPECT_LT(d.mean(), limit);
                EXPECT_LT(d.largest_inside, 0.002);
            }
        ++turn;  // the next surface has other axes
    }
}

// Rays pass few voxels from corner to corner and many beside corners, so what they cover is right
// on average.
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
