// SPDX-License-Identifier: Apache-2.0
// The medium in lattices: each voxel of space has the medium's colour and the opacity of a way
// through it, compared with sums in double precision.
#include <gmock/gmock.h>

#include <functional>
#include <map>

#include "runtime/base/main_memory.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/stages/display/display_medium.hpp"
#include "tests/support/display_fixture.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {
namespace {

/// A density at the world's points; each voxel has the density at its middle.
using Density = std::function<double(const glm::dvec3& p)>;

constexpr double kEdge = 0.1;
const glm::dvec3 kMin{-0.7, -0.5, -0.9};
const glm::ivec3 kVoxels{14, 10, 18};

constexpr const char* kWorld = R"({"voxelume": 1,
"world": {"voxel_size": 0.1, "bounds": {"min": [-0.7, -0.5, -0.9], "max": [0.7, 0.5, 0.9]},
  "ambient": [1, 1, 1], "medium": MEDIUM},
"materials": {"veil": {"color": [0.5, 0.7, 0.9], "opacity": 0.4, "diffuse": 0},
              "wall": {"color": [0.9, 0.1, 0.2]}},
"models": {"ball": {"shape": "sphere", "radius": 0.25, "voxel_size": 0.1, "surface": "exact"}},
"objects": [OBJECTS], "lights": [],
"observer": {OBSERVER}, "render": {"size": [8, 8]}})";

std::string fog_scene(const std::string& medium, const std::string& objects,
                      const std::string& observer) {
    std::string text = kWorld;
    for (const auto& [word, value] : std::initializer_list<std::pair<const char*, std::string>>{
             {"MEDIUM", medium}, {"OBJECTS", objects}, {"OBSERVER", observer}})
        text.replace(text.find(word), std::string(word).size(), value);
    return text;
}

/// The mean of a density over a voxel of a lattice, by `parts` points along each edge.
double mean_density(const VolumeFrame& frame, const glm::ivec3& cell, const Density& density,
                    int parts) {
    double sum = 0;
    for (int z = 0; z < parts; ++z)
        for (int y = 0; y < parts; ++y)
            for (int x = 0; x < parts; ++x) {
                const glm::dvec3 within = (glm::dvec3(x, y, z) + 0.5) / double(parts);
                const glm::dvec3 p_observer =
                    frame.origin + frame.edge * (glm::dvec3(cell) + within);
                const glm::dvec3 p(frame.world_from_observer * glm::dvec4(p_observer, 1));
                const glm::dvec3 voxel = glm::floor((p - kMin) / kEdge);
                if (glm::any(glm::lessThan(voxel, glm::dvec3(0))) ||
                    glm::any(glm::greaterThanEqual(voxel, glm::dvec3(kVoxels))))
                    continue;
                sum += density(kMin + (voxel + 0.5) * kEdge);
            }
    return sum / (double(parts) * parts * parts);
}

const Density kFogOnGround = [](const glm::dvec3& p) {
    return p.y <= -0.2 ? 1.0 : std::exp(-(p.y + 0.2) / 0.3);
};
constexpr const char* kFogKeys = R"({"absorption": [2, 3, 5], "color": [0.7, 0.5, 0.9],
  "density": {"kind": "height", "base": -0.2, "scale_height": 0.3}})";
const glm::dvec3 kFogAbsorption{2, 3, 5}, kFogColor{0.7, 0.5, 0.9};

/// Compares a voxel with a medium of one colour, of which it shows `amount`.
void expect_fog(const Volume& volume, size_t i, double amount, double tolerance) {
    const double opacity = -std::expm1(-kFogAbsorption.x * amount);
    EXPECT_NEAR(volume.opacities[i], opacity, tolerance) << i;
    for (int c = 0; c < 3; ++c) {
        const double light = kFogColor[c] * -std::expm1(-kFogAbsorption[c] * amount);
        EXPECT_NEAR(volume.colors[i][c] * volume.opacities[i], light, tolerance) << i;
    }
}

TEST(LatticeMedium, HasTheOpacityAndColorOfAWayThroughEachVoxelAlongTheSightLines) {
    // Lines cross a voxel of the lattice in half voxels of the world: their mean is exact.
    const Scene scene = parsed(fog_scene(kFogKeys, "", R"("position": [0, 0, -2],
"display": {"shape": "box", "size": [2.1, 1.5, 2.4], "near": 1, "voxels": [14, 10, 16],
            "layout": "lattice"})"));
    const Volume volume = volume_of(scene);
    ASSERT_TRUE(find_fault(volume).empty()) << find_fault(volume);
    std::map<uint64_t, size_t> shown;
    for (size_t i = 0; i < volume.indices.size(); ++i) shown[volume.indices[i]] = i;
    size_t dense = 0;
    for (uint64_t index = 0; index < voxel_count(volume.frame); ++index) {
        const glm::ivec3 cell = cell_of(volume.frame, index);
        const double mean = mean_density(volume.frame, cell, kFogOnGround, 24);
        const auto at = shown.find(index);
        if (mean <= 0) {
            EXPECT_EQ(at, shown.end()) << index;
            continue;
        }
        ASSERT_NE(at, shown.end()) << index;
        EXPECT_EQ(volume.kinds[at->second], VoxelKind::space);
        EXPECT_NEAR(volume.depths[at->second], 1 + 0.15 * (cell.z + 0.5), 1e-6);
        expect_fog(volume, at->second, mean * 0.15, 2e-5);
        ++dense;
    }
    EXPECT_EQ(dense, shown.size());
    EXPECT_GT(dense, 1000u);
}

TEST(LatticeMedium, IsMeasuredAlongObliqueSightLinesOfTurnedObservers) {
    const Scene scene = parsed(fog_scene(kFogKeys, "", R"("position": [-1.4, 0.9, -1.6],
"look_at": [0, -0.1, 0], "display": {"shape": "pyramid", "angles": [50, 40], "near": 1, "far": 3,
            "voxels": [24, 20, 22], "layout": "lattice"})"));
    const Volume volume = volume_of(scene);
    ASSERT_GT(volume.indices.size(), 1000u);
    double off = 0, largest = 0;
    for (size_t i = 0; i < volume.indices.size(); i += 7) {
        const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
        // The mean over parallels of a line is the volume by the area across them.
        const glm::dvec3 &e = volume.frame.edge,
                         d = glm::abs(
                             glm::normalize(volume.frame.origin + e * (glm::dvec3(cell) + 0.5)));
        const double length =
            e.x * e.y * e.z / (e.y * e.z * d.x + e.x * e.z * d.y + e.x * e.y * d.z);
        const double amount = length * mean_density(volume.frame, cell, kFogOnGround, 12);
        const double opacity = -std::expm1(-kFogAbsorption.x * amount);
        off += volume.opacities[i] - opacity;
        largest = std::max(largest, std::abs(volume.opacities[i] - opacity));
    }
    // Four lines stand for a voxel that is turned against those of the world.
    EXPECT_LT(std::abs(off) / (double(volume.indices.size()) / 7), 5e-4);
    EXPECT_LT(largest, 0.02);
}

TEST(LatticeMedium, LaidOverOneAnotherIsTheFlatImage) {
    // The lattice's columns are the world's: a sight ray has the mean of its column.
    const std::string box = R"("position": [0, 0, -2],
"display": {"shape": "box", "size": [1.4, 1, 1.8], "near": 1.1, "voxels": [14, 10, 18])";
    const Volume volume =
        volume_of(parsed(fog_scene(kFogKeys, "", box + R"(, "layout": "lattice"})")));
    Scene scene = parsed(fog_scene(kFogKeys, "", box + "}"));
    scene.render.size = {14, 10};
    scene.world.background = glm::vec3(0);
    RenderReport report;
    const Image image = render(shared_device(), scene, report);
    std::vector<double> light(140, 0.0), left(140, 1.0);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const glm::ivec3 cell = cell_of(volume.frame, volume.indices[i]);
        const size_t pixel = size_t(13 - cell.x + 14 * (9 - cell.y));
        light[pixel] += left[pixel] * double(volume.opacities[i]) * double(volume.colors[i].x);
        left[pixel] *= 1 - double(volume.opacities[i]);
    }
    for (size_t i = 0; i < 140; ++i) EXPECT_NEAR(light[i], image.planes.at("R")[i], 1e-5) << i;
}

TEST(LatticeMedium, IsUnseenBehindAndInsideObjects) {
    const std::string ball = R"({"model": "ball", "material": ")";
    const auto shown_near = [&](const std::string& material, const char* visibility) {
        const Volume volume = volume_of(parsed(
            fog_scene(kFogKeys, ball + material + R"("})",
                      R"("position": [0, 0, -2], "display": {"shape": "box", "size": [1.4, 1, 1.8],
"near": 1.1, "voxels": [28, 20, 36], "layout": "lattice", "visibility": ")" +
                          std::string(visibility) + R"("})")));
        glm::ivec3 found(0);  // space voxels in the ball, behind it, and beside it
        for (size_t i = 0; i < volume.indices.size(); ++i) {
            if (volume.kinds[i] != VoxelKind::space) continue;
            const glm::dvec3 p =
                voxel_center(volume.frame, cell_of(volume.frame, volume.indices[i]));
            const double across = std::hypot(p.x, p.y);
            if (glm::length(p) < 0.22) ++found.x;
            if (p.z > 0.3 && across < 0.22) ++found.y;
            if (p.z > 0.3 && across > 0.3) ++found.z;
        }
        return found;
    };
    const glm::ivec3 wall = shown_near("wall", "observer"), veil = shown_near("veil", "observer"),
                     outside = shown_near("wall", "outside"), all = shown_near("wall", "all");
    EXPECT_EQ(wall.x, 0);
    EXPECT_EQ(wall.y, 0);
    EXPECT_GT(wall.z, 1000);
    EXPECT_EQ(veil.x, 0);
    EXPECT_GT(veil.y, 500);
    EXPECT_EQ(outside.x, 0);
    EXPECT_EQ(outside.y, veil.y);
    EXPECT_GT(all.x, 100);
}

TEST(LatticeMedium, CoversASurfaceThatLetsLightThroughByHalfOfItsVoxel) {
    Volume volume;
    volume.frame.size = {2, 1, 1};
    volume.frame.edge = {0.5, 0.5, 0.5};
    volume.frame.display.shape = DisplayShape::box;
    volume.indices = {1};
    volume.colors = {{1, 0, 0.5F}};
    volume.opacities = {0.4F};
    volume.depths = {3};
    volume.objects = {7};
    volume.kinds = {VoxelKind::object};
    Medium medium;
    medium.absorption = glm::vec3(2);
    medium.color = {0.25F, 0.5F, 1};
    add_medium_voxels({{0, 1}, {1, 0.5F}, {}}, medium, volume);
    ASSERT_EQ(volume.indices, (std::vector<uint64_t>{0, 1}));
    EXPECT_EQ(volume.objects, (std::vector<uint32_t>{0, 7}));
    EXPECT_NEAR(volume.opacities[0], 1 - std::exp(-1.0), 1e-7);
    const double own = 1 - std::exp(-0.5);
    EXPECT_NEAR(volume.opacities[1], 1 - 0.6 * (1 - own), 1e-7);
    const double in_front = 0.25 * own + (1 - own) * 0.4, behind = 0.4 + 0.6 * 0.25 * own;
    EXPECT_NEAR(volume.colors[1].x * volume.opacities[1], (in_front + behind) / 2, 1e-7);
}

TEST(LatticeMedium, OfMoreVoxelsThanMainMemoryHoldsIsRefused) {
    const Scene scene = parsed(fog_scene(kFogKeys, "", R"("position": [0, 0, -2],
"display": {"shape": "box", "size": [1.4, 1, 1.8], "near": 1.1, "voxels": [14, 10, 18],
            "layout": "lattice"})"));
    RenderReport report;
    const BuiltWorld world =
        WorldBuilder(shared_device(), false, AssetStore()).build(scene, report.world);
    limit_main_memory(100'000);
    const Error error = error_of([&] { render_volume(shared_device(), scene, world, report); });
    limit_main_memory(0);
    EXPECT_EQ(error.kind(), ErrorKind::limit);
    EXPECT_THAT(error.what(), testing::HasSubstr("use fewer display voxels"));
}

class LatticeScan : public FileTest {
  protected:
    /// A scan whose values are 10 times the numbers of its cells along z, around the origin.
    void SetUp() override {
        FileTest::SetUp();
        std::string text =
            "NRRD0004\ntype: uchar\ndimension: 3\nsizes: 14 10 18\nspace directions: (0.1,0,0) "
            "(0,0.1,0) (0,0,0.1)\nspace dimension: 3\nspace origin: (-0.65,-0.45,-0.85)\n"
            "encoding: raw\n\n";
        for (int z = 0; z < 18; ++z) text.append(140, char(10 * z));
        put_bytes(folder / "scan.nrrd", text);
    }

    Scene scene_seen(const std::string& more) const {
        return parse_scene(
            fog_scene(R"({"absorption": [1, 2, 1], "density": {"kind": "grid", "file": "scan.nrrd",
"transfer": [{"value": 0, "absorption": 2, "color": [1, 0, 0]},
             {"value": 170, "absorption": 8, "color": [0, 0.5, 1]}]}})",
                      "",
                      R"("position": [0, 0, -2], "display": {"shape": "box",
"size": [1.4, 1, 1.8], "near": 1.1, "voxels": [7, 5, 9], "layout": "lattice", "seen_along": "x")" +
                          more + "}"),
            folder / "scene.json", {folder});
    }
};

TEST_F(LatticeScan, HasTheColorsOfItsTransferFunction) {
    const Volume volume = volume_of(scene_seen(""));
    ASSERT_EQ(volume.indices.size(), 7u * 5 * 9);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        // Two cells along z lie in a voxel; absorption, and absorption times colour, are linear.
        const int k = cell_of(volume.frame, volume.indices[i]).z;
        if (k == 0 || k == 8) continue;  // where the scan ends
        const double share = (20.0 * k + 5) / 170, absorption = 2 + 6 * share;
        EXPECT_NEAR(volume.opacities[i], -std::expm1(-absorption * 0.2), 1e-5) << k;
        const glm::dvec3 emitted = (1 - share) * glm::dvec3(2, 0, 0) + share * glm::dvec3(0, 4, 8);
        const glm::dvec3 color = emitted / absorption, factor(1, 2, 1);
        for (int c = 0; c < 3; ++c)
            EXPECT_NEAR(volume.colors[i][c] * volume.opacities[i],
                        color[c] * -std::expm1(-absorption * factor[c] * 0.2), 1e-5)
                << k << " " << c;
    }
}

TEST_F(LatticeScan, HasTheSameBitsForEveryNumberOfLanes) {
    if (!is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    const Volume one = volume_of(scene_seen(""), 1);
    for (const int lanes : {4, 8, 16}) {
        const Volume more = volume_of(scene_seen(""), lanes);
        EXPECT_EQ(one.colors, more.colors) << lanes;
        EXPECT_EQ(one.opacities, more.opacities) << lanes;
    }
}

}  // namespace
}  // namespace voxelume
