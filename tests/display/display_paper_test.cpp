// SPDX-License-Identifier: Apache-2.0
// The paper's formula, voxel by voxel, on a world of 8 x 6 x 4 voxels of a metre: two objects, one
// light and a medium that absorbs.
//
//   z 0..1   space          the observer looks along +Z, and the display is the world
//   z 1..3   the block: x 2..4, y 2..4
//   z 3..4   the wall:  x 1..7, y 1..5
#include <gtest/gtest.h>

#include <cmath>
#include <map>

#include "runtime/render/volume_renderer.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "tests/support/test_device.hpp"

namespace voxelume {
namespace {

constexpr const char* kPaperScene = R"({"voxelume": 1,
"world": {"voxel_size": 1, "bounds": {"min": [0, 0, 0], "max": [8, 6, 4]},
          "background": [9, 9, 9], "ambient": [0.5, 0.25, 0.75],
          "medium": {"absorption": [0.1, 0.2, 0.4], "color": [0.05, 0.1, 0.02]}},
"materials": {"block": {"color": [0.8, 0.4, 0.2], "diffuse": 0.5, "specular": 0.25, "shininess": 8},
              "wall": {"color": [0.3, 0.6, 0.9], "diffuse": 1, "emission": [0.01, 0.02, 0.03]}},
"models": {"block": {"shape": "box", "size": [2, 2, 2], "voxel_size": 1, "surface": "cubes",
                     "set": "solid"},
           "wall": {"shape": "box", "size": [6, 4, 2], "voxel_size": 1, "surface": "cubes",
                    "set": "solid"}},
"objects": [{"name": "block", "model": "block", "material": "block", "position": [3, 3, 2]},
            {"name": "wall", "model": "wall", "material": "wall", "position": [4, 3, 4]}],
"lights": [{"type": "point", "position": [1.5, 4.5, -2], "color": [1, 0.5, 0.25], "intensity": 40}],
"observer": {"position": [4, 3, -1],
             "display": {"shape": "box", "size": [8, 6, 4], "near": 1, "voxels": [8, 6, 4]}},
"render": {"size": [8, 6]}})";

constexpr double kAbsorption[3] = {0.1, 0.2, 0.4}, kMedium[3] = {0.05, 0.1, 0.02};
constexpr double kAmbient[3] = {0.5, 0.25, 0.75}, kLight[3] = {40, 20, 10};

struct Surface {
    uint32_t object;
    double z;  ///< of the face towards the observer
    double color[3], diffuse, specular, shininess, emission[3];
};
constexpr Surface kBlock = {1, 1, {0.8, 0.4, 0.2}, 0.5, 0.25, 8, {0, 0, 0}};
constexpr Surface kWall = {2, 3, {0.3, 0.6, 0.9}, 1, 0, 50, {0.01, 0.02, 0.03}};

const Surface* surface_at(double x, double y) {
    if (x > 2 && x < 4 && y > 2 && y < 4) return &kBlock;
    if (x > 1 && x < 7 && y > 1 && y < 5) return &kWall;
    return nullptr;
}

/// True if the block lies between the wall at (x, y, 3) and the light at (1.5, 4.5, -2). The way to
/// the light leaves the block's range of z, at z = 1, after two fifths of its length.
bool is_in_shade(double x, double y) {
    double first = 0, last = 0.4;
    const double from[2] = {x, y}, way[2] = {1.5 - x, 4.5 - y};
    for (int axis = 0; axis < 2; ++axis) {
        if (way[axis] == 0) {
            if (from[axis] <= 2 || from[axis] >= 4) return false;
            continue;
        }
        const double a = (2 - from[axis]) / way[axis], b = (4 - from[axis]) / way[axis];
        first = std::max(first, std::min(a, b));
        last = std::min(last, std::max(a, b));
    }
    return first < last;
}

/// The light that leaves the face at (x, y) towards the observer, by the paper's blocks 4 and 5.
double surface_light(const Surface& s, double x, double y, int c) {
    double light = s.emission[c] + s.color[c] * s.diffuse * kAmbient[c];
    if (&s == &kWall && is_in_shade(x, y)) return light;
    const double lx = 1.5 - x, ly = 4.5 - y, lz = -2 - s.z;
    const double squared = lx * lx + ly * ly + lz * lz, length = std::sqrt(squared);
    const double cosine = -lz / length;
    // The half vector between the light and the viewer, who is at (0, 0, -1).
    const double hz = lz / length - 1;
    const double h = -hz / std::sqrt((lx * lx + ly * ly) / squared + hz * hz);
    const double in_medium = length * s.z / (s.z + 2);  // the light stands 2 m before the world
    const double share = s.color[c] * s.diffuse * cosine + s.specular * std::pow(h, s.shininess);
    light += share * kLight[c] / squared * std::exp(-kAbsorption[c] * in_medium);
    return light;
}

/// C_P of a metre of space, k metres inside the medium: the light that it adds, divided by the
/// opacity 1 - e^-0.1 with which it covers. It includes the channel's loss in front of it beyond
/// what those opacities take.
double space_color(int k, int c) {
    const double lost = std::exp(-(kAbsorption[c] - 0.1) * k);
    return kMedium[c] * (1 - std::exp(-kAbsorption[c])) / (1 - std::exp(-0.1)) * lost;
}

TEST(PaperFormula, HoldsForEveryVoxelOfSightRays) {
    RenderReport report;
    const Volume p =
        render_volume(test_device(), parse_scene(kPaperScene, "test.json", {}), report);
    std::map<uint64_t, size_t> number;
    for (size_t i = 0; i < p.indices.size(); ++i) number[p.indices[i]] = i;
    size_t expected = 0, shaded = 0;
    for (int v = 0; v < 6; ++v) {
        for (int u = 0; u < 8; ++u) {
            const double x = 7.5 - u, y = 5.5 - v;  // image right is -X, image down is -Y
            const Surface* surface = surface_at(x, y);
            const int end = surface ? int(surface->z) : 4;
            for (int k = 0; k < 4; ++k) {
                const uint64_t index = uint64_t(u + 8 * (v + 6 * k));
                SCOPED_TRACE(testing::Message() << "u " << u << " v " << v << " k " << k);
                if (surface && k > end) {
                    EXPECT_FALSE(number.contains(index)) << "behind the surface nothing is seen";
                    continue;
                }
                ++expected;
                ASSERT_TRUE(number.contains(index));
                const size_t i = number[index];
                const bool is_space = k < end;
                EXPECT_EQ(p.kinds[i], is_space ? VoxelKind::space : VoxelKind::object);
                EXPECT_EQ(p.objects[i], is_space ? 0 : surface->object);
                EXPECT_NEAR(p.opacities[i], is_space ? 1 - std::exp(-0.1) : 1, 1e-7);
                EXPECT_NEAR(p.depths[i], is_space ? 1.5 + k : 1 + end, 1e-6);
                for (int c = 0; c < 3; ++c) {
                    const double color = is_space
                                             ? space_color(k, c)
                                             : surface_light(*surface, x, y, c) *
                                                   std::exp(-(kAbsorption[c] - 0.1) * surface->z);
                    EXPECT_NEAR(p.colors[i][c], color, 2e-6 * std::max(color, 0.5))
                        << "channel " << c;
                }
            }
            shaded += surface == &kWall && is_in_shade(x, y);
        }
    }
    EXPECT_EQ(p.indices.size(), expected);
    EXPECT_GE(shaded, 3u);
}

TEST(PaperFormula, HoldsForTheSurfacesAndTheSpaceOfALattice) {
    Scene scene = parse_scene(kPaperScene, "test.json", {});
    scene.observer.display.layout = VolumeLayout::lattice;
    // Each voxel of the world has more than four probe points, and no face lies between voxels of
    // the display.
    scene.observer.display.voxels = {24, 18, 5};
    RenderReport report;
    const Volume p = render_volume(test_device(), scene, report);
    size_t fronts[2] = {}, spaces = 0;
    for (size_t i = 0; i < p.indices.size(); ++i) {
        if (p.objects[i] == 0) {  // 0.8 m of the medium, seen along Z_E
            const double opacity = -std::expm1(-kAbsorption[0] * 0.8);
            EXPECT_EQ(p.kinds[i], VoxelKind::space);
            EXPECT_NEAR(p.opacities[i], opacity, 1e-6);
            for (int c = 0; c < 3; ++c)
                EXPECT_NEAR(p.colors[i][c] * opacity,
                            kMedium[c] * -std::expm1(-kAbsorption[c] * 0.8), 1e-6);
            ++spaces;
            continue;
        }
        EXPECT_EQ(p.opacities[i], 1.0f);
        EXPECT_EQ(p.kinds[i], VoxelKind::object);
        ASSERT_TRUE(p.objects[i] == 1 || p.objects[i] == 2);
        const Surface& surface = p.objects[i] == 1 ? kBlock : kWall;
        if (std::abs(p.depths[i] - 1 - surface.z) > 1e-5) continue;  // a side face
        ++fronts[p.objects[i] - 1];
        // The point may be lit at any of the voxel's four corners, which are equally near to its
        // middle.
        const double x = double(p.indices[i] % 24) / 3, y = double(p.indices[i] / 24 % 18) / 3;
        bool is_one = false;
        for (const double dx : {0.0, 1.0 / 3})
            for (const double dy : {0.0, 1.0 / 3}) {
                double maximum = 0;
                for (int c = 0; c < 3; ++c)
                    maximum =
                        std::max(maximum, std::abs(double(p.colors[i][c]) -
                                                   surface_light(surface, x + dx, y + dy, c)));
                is_one |= maximum < 2e-5;
            }
        EXPECT_TRUE(is_one) << "at " << x << " " << y << ", object " << p.objects[i];
    }
    EXPECT_GE(fronts[0], 36u);
    EXPECT_GE(fronts[1], 150u);
    EXPECT_GE(spaces, 24u * 18 * 5 / 2);
}

}  // namespace
}  // namespace voxelume
