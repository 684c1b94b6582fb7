// SPDX-License-Identifier: Apache-2.0
// Every scene of scenes/ with all objects in the world and with all as instances: each pixel that
// differs has a cause, which is checked there.
#include <fmt/format.h>
#include <gtest/gtest.h>

#include <array>
#include <filesystem>
#include <ostream>
#include <set>
#include <string>

#include "runtime/analysis/scene_choices.hpp"
#include "tests/instance/placement_pair.hpp"
#include "tests/support/exhaustive.hpp"

namespace voxelume {
namespace {

/// A scene, and the most voxels that its world has along an axis in the test. Files of voxels can't
/// be coarsened.
struct ShippedScene {
    const char* name;
    double voxels = 96;
    bool is_default = false;  ///< otherwise only an exhaustive run draws it
    size_t far_edges = 0;     ///< maximum of pixels that differ by 0.01 voxels of a ray's place
};

/// The name of a case for GoogleTest.
void PrintTo(const ShippedScene& scene, std::ostream* out) {
    *out << scene.name;
}

constexpr std::array kShipped = {ShippedScene{"bunny", 96, true},
                                 ShippedScene{"solids", 96, true},
                                 ShippedScene{"lamp", 96, true},
                                 ShippedScene{"cornell", 96, true},
                                 ShippedScene{"cubes"},
                                 ShippedScene{"daylight", 480},
                                 ShippedScene{"drill"},
                                 ShippedScene{"fog"},
                                 ShippedScene{"glass_bunny", 192},
                                 ShippedScene{"melt"},
                                 ShippedScene{"nautilus"},
                                 ShippedScene{"pendulum"},
                                 ShippedScene{"prism"},
                                 ShippedScene{"procession"},
                                 ShippedScene{"stage"},
                                 ShippedScene{"stained_glass"},
                                 ShippedScene{"still_life"},
                                 ShippedScene{"turntable"},
                                 ShippedScene{"voxels", 1720, false, 8},
                                 ShippedScene{"whitted", 96, false, 1}};

TEST(ShippedPlacements, AreThoseOfAllScenes) {
    std::set<std::string> tested, shipped;
    for (const ShippedScene& scene : kShipped) tested.insert(scene.name);
    for (const auto& entry : std::filesystem::directory_iterator(kScenes))
        if (entry.path().extension() == ".json" && entry.path().stem().extension().empty())
            shipped.insert(entry.path().stem());
    EXPECT_EQ(tested, shipped);
}

/// Why an object of the scene isn't an instance: endless ones, and cubes that light goes through.
void expect_reason(const Scene& scene, const Object& object) {
    const Model& model = scene.models[size_t(object.model)];
    const bool is_endless = model.solid && is_infinite(*model.solid);
    EXPECT_TRUE(is_endless || (transmits(scene, object) && shows_voxels(model.surface)))
        << object.name;
}

class ShippedPlacement : public testing::TestWithParam<ShippedScene> {};
INSTANTIATE_TEST_SUITE_P(Scenes, ShippedPlacement, testing::ValuesIn(kShipped),
                         [](const auto& test) { return std::string(test.param.name); });

TEST_P(ShippedPlacement, DiffersAtPixelsWithACauseAlone) {
    const ShippedScene& shipped = GetParam();
    if (!shipped.is_default && !is_exhaustive()) GTEST_SKIP() << kOnlyWithAll;
    Scene scene = small_scene(shipped.name, {96, 72}, shipped.voxels);
    AssetStore meshes;
    make_choices(scene, meshes);
    size_t instances = 0;
    for (const Object& object : scene.objects)
        if (can_be_instance(scene, object))
            ++instances;
        else
            expect_reason(scene, object);
    EXPECT_GT(instances, 0u);
    PlacementPair pair(scene);
    std::array<size_t, kCauseNames.size()> counts{};
    glm::dvec3 before(0), after(0);
    for (size_t i = 0; i < pair.pictures().world.planes.at("Z").size(); ++i) {
        const Pixel a = pixel_of(pair.pictures().world, i);
        const Pixel b = pixel_of(pair.pictures().instances, i);
        const Cause cause = pair.cause_of(i);
        ++counts[size_t(cause)];
        before += a.light;
        after += b.light;
        if (cause == Cause::unexplained)
            fmt::print(
                "  pixel {}, {}: object {} and {}, {:.5f} m apart, light {:.4f} and {:.4f}\n",
                i % 96, i / 96, a.object, b.object, glm::length(a.p - b.p), glm::compAdd(a.light),
                glm::compAdd(b.light));
    }
    std::string line = fmt::format("{}, {} instances:", shipped.name, instances);
    for (size_t i = 0; i < counts.size(); ++i)
        if (counts[i] > 0) line += fmt::format(" {} {},", counts[i], kCauseNames[i]);
    const double light = glm::compAdd(after) / glm::compAdd(before);
    fmt::print("{} {:.4f} of the light\n", line, light);
    EXPECT_EQ(counts[size_t(Cause::unexplained)], 0u);
    EXPECT_LE(counts[size_t(Cause::far_edge)], shipped.far_edges);
    // Turned cubes have other faces.
    EXPECT_NEAR(light, 1, counts[size_t(Cause::lattice)] > 0 ? 0.03 : 0.01);
}

}  // namespace
}  // namespace voxelume
