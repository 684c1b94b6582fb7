// SPDX-License-Identifier: Apache-2.0
// Volumetric images by sight rays: where they place surfaces, and that their composited voxels are
// the flat image.
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

#include "tests/support/display_fixture.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

/// A sight ray of the world by the manual's table; `direction` is as long as one metre of depth.
struct ManualRay {
    glm::dvec3 start, direction;
    bool is_one = true;  ///< false in the corners of a sector's image, which have no ray
};

ManualRay manual_ray(const Observer& observer, double u, double v, glm::dvec2 size) {
    const Display& d = observer.display;
    const double x = 2 * u / size.x - 1, y = 1 - 2 * v / size.y;  // right, up
    glm::dvec3 start(0), way(0, 0, 1);
    ManualRay ray;
    if (d.shape == DisplayShape::pyramid) {
        way = {x * std::tan(d.half_angles.x), y * std::tan(d.half_angles.y), 1};
    } else if (d.shape == DisplayShape::box) {
        start = {x * d.half_size.x, y * d.half_size.y, 0};
    } else if (d.shape == DisplayShape::sector) {
        const double r = std::hypot(x, y), angle = r * d.half_angles.x;
        ray.is_one = r <= 1;
        if (r > 0) way = {std::sin(angle) * x / r, std::sin(angle) * y / r, std::cos(angle)};
    } else {
        const double longitude = x * M_PI, latitude = y * M_PI / 2;
        way = {std::sin(longitude) * std::cos(latitude), std::sin(latitude),
               std::cos(longitude) * std::cos(latitude)};
    }
    const auto to_world = [&](const glm::dvec3& p) {
        return observer.world_from_observer * glm::dvec3(-p.x, p.y, p.z);  // image right is -X_E
    };
    ray.start = observer.position + to_world(start);
    ray.direction = to_world(way);
    return ray;
}

constexpr int kNone = -1;

/// The step of the first surface on a sight ray, moved by `shift` metres along it, or kNone.
int step_seen(const Scene& scene, double u, double v, double shift) {
    const Display& d = scene.observer.display;
    const ManualRay ray = manual_ray(scene.observer, u, v, glm::dvec2(d.voxels));
    if (!ray.is_one) return kNone;
    const auto t = display_solids().first_hit(ray.start, ray.direction, d.near);
    if (!t || *t > d.far) return kNone;
    return int((*t + shift - d.near) / (d.far - d.near) * d.voxels.z);
}

class Rays : public testing::TestWithParam<DisplayCase> {};

TEST_P(Rays, ShowExactlyTheFirstSurfaceOfEverySightRay) {
    for (const char* surface : {"exact", "smooth"}) {
        const bool exact = std::string(surface) == "exact";
        const Scene scene = parsed(
            display_scene(std::string(GetParam().keys) + R"(, "voxels": [97, 71, 83])", surface));
        const Volume volume = volume_of(scene);
        ASSERT_TRUE(std::ranges::is_sorted(volume.indices));
        ASSERT_EQ(std::ranges::adjacent_find(volume.indices), volume.indices.end());
        std::vector<int> shown(97 * 71, kNone);
        for (const uint64_t index : volume.indices) {
            ASSERT_EQ(shown[index % (97 * 71)], kNone) << "two voxels on a ray";
            shown[index % (97 * 71)] = int(index / (97 * 71));
        }
        size_t certain = 0, wrong = 0;
        for (int v = 0; v < 71; ++v)
            for (int u = 0; u < 97; ++u) {
                // Smooth surfaces round edges off within their voxel, by less than a tenth of it,
                // so a few rays there may go either way.
                const double around = exact ? 1e-3 : 0.45, rounded = exact ? 0 : 0.1 * 0.04;
                std::set<int> may;
                for (const double du : {-around, 0.0, around})
                    for (const double dv : {-around, 0.0, around})
                        for (const double shift : {-rounded, 0.0, rounded})
                            may.insert(step_seen(scene, u + 0.5 + du, v + 0.5 + dv, shift));
                certain += may.size() == 1;
                if (may.size() == 1 || exact) wrong += !may.contains(shown[size_t(v * 97 + u)]);
            }
        EXPECT_EQ(wrong, 0u) << surface << ", " << certain << " certain rays";
        EXPECT_GT(certain, exact ? 6800u : 4000u) << surface;
    }
}

TEST_P(Rays, HoldSurfacesWithinHalfAStep) {
    const Scene scene =
        parsed(display_scene(std::string(GetParam().keys) + R"(, "voxels": [60, 44, 52])"));
    const Volume volume = volume_of(scene);
    ASSERT_GT(volume.indices.size(), 20u);
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const uint64_t index = volume.indices[i];
        const double u = double(index % 60) + 0.5, v = double(index / 60 % 44) + 0.5;
        const double depth =
            scene.observer.display.near + volume.frame.step * (double(index / (60 * 44)) + 0.5);
        const ManualRay ray = manual_ray(scene.observer, u, v, {60, 44});
        const double half = 0.5 * volume.frame.step * glm::length(ray.direction);
        EXPECT_LE(display_solids().distance(ray.start + ray.direction * depth), half + 1e-5);
        const glm::dvec3 at = ray.start + ray.direction * double(volume.depths[i]);
        EXPECT_LE(display_solids().distance(at), 2e-5);
        EXPECT_EQ(volume.opacities[i], 1.0f);
        EXPECT_TRUE(volume.objects[i] == 1 || volume.objects[i] == 2);
    }
}

INSTANTIATE_TEST_SUITE_P(Shapes, Rays, testing::ValuesIn(kDisplayCases),
                         [](const auto& shape) { return shape.param.name; });

constexpr const char* kPointLight =
    R"({"type": "point", "position": [-1, 2, -1.5], "intensity": 6},
       {"type": "directional", "direction": [1, -1, 0.4], "color": [0.2, 0.3, 0.4]})";

/// Compares a flattened volume with the flat image of the same observer. If `everywhere`, compares
/// pixels that hit nothing, too.
void expect_flattens_to_the_image(Scene scene, bool everywhere) {
    const Volume volume = volume_of(scene);
    resize(scene, {scene.observer.display.voxels.x, scene.observer.display.voxels.y});
    RenderReport report;
    const Image image = render(test_device(), scene, report);
    const std::vector<glm::dvec3> flat = flattened(volume, glm::dvec3(scene.world.background));
    size_t compared = 0;
    for (size_t i = 0; i < flat.size(); ++i) {
        if (!everywhere && image.planes.at("A")[i] == 0) continue;
        ++compared;
        for (int c = 0; c < 3; ++c)
            ASSERT_NEAR(flat[i][c], image.planes.at(std::string(1, "RGB"[c]))[i], 1e-5) << i;
    }
    EXPECT_GT(compared, 300u);
}

TEST(Flattened, IsTheFlatImageInClearSpace) {
    for (const DisplayCase& shape : kDisplayCases)
        expect_flattens_to_the_image(
            parsed(display_scene(std::string(shape.keys) + R"(, "voxels": [64, 48, 100])", "smooth",
                                 "", kPointLight)),
            true);
}

TEST(Flattened, IsTheFlatImageInAGreyMedium) {
    for (const DisplayCase& shape : kDisplayCases)
        expect_flattens_to_the_image(
            parsed(display_scene(
                std::string(shape.keys) + R"(, "voxels": [64, 48, 100])", "exact",
                R"(, "medium": {"absorption": [0.4, 0.4, 0.4], "color": [0.3, 0.2, 0.1]})",
                kPointLight)),
            true);
}

TEST(Flattened, IsTheFlatImageOfSurfacesInAColouredMedium) {
    for (const char* medium :
         {R"(, "medium": {"absorption": [0.05, 0.02, 0.01], "color": [0, 0, 0]})",
          R"(, "medium": {"absorption": [0.3, 1, 2.5], "color": [0.4, 0.2, 0.6]})",
          R"(, "medium": {"absorption": [0, 0.5, 0.9], "color": [0.1, 0.2, 0.3]})"})
        expect_flattens_to_the_image(parsed(display_scene(std::string(kDisplayCases[0].keys) +
                                                              R"(, "voxels": [64, 48, 100])",
                                                          "exact", medium, kPointLight)),
                                     false);
}

TEST(Rays, AnEmptyWorldShowsNothing) {
    Scene scene = parsed(display_scene(kDisplayCases[0].keys));
    scene.objects.clear();
    EXPECT_TRUE(volume_of(scene).indices.empty());
    scene.observer.display.layout = VolumeLayout::lattice;
    EXPECT_TRUE(volume_of(scene).indices.empty());
}

/// All values of a volume as bytes.
std::string bytes_of(const Volume& volume) {
    std::string bytes;
    const auto add = [&bytes](const auto& values) {
        bytes.append(reinterpret_cast<const char*>(values.data()),
                     values.size() * sizeof(values[0]));
    };
    add(volume.indices), add(volume.colors), add(volume.opacities);
    add(volume.depths), add(volume.objects), add(volume.kinds);
    return bytes;
}

TEST(Volume, HasTheSameBitsForEveryNumberOfLanes) {
    for (const std::string layout : {"rays", "lattice"}) {
        const Scene scene = parsed(display_scene(
            fmt::format(R"({}, "layout": "{}", "voxels": [40, 30, 36])", kDisplayCases[0].keys,
                        layout),
            "smooth", R"(, "medium": {"absorption": [0.3, 1, 2], "color": [0.4, 0.2, 0.6]})",
            kPointLight));
        const std::string expected = bytes_of(volume_of(scene, 16));
        ASSERT_GT(expected.size(), 3000u);
        for (const int lanes : in_turn<int>({1, 4, 8}, layout == "rays" ? 0 : 1))
            EXPECT_TRUE(bytes_of(volume_of(scene, lanes)) == expected)
                << layout << ", " << lanes << " lanes";
    }
}

}  // namespace
}  // namespace voxelume
