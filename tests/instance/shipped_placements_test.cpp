// SPDX-License-Identifier: Apache-2.0
// Scenes of scenes/ look alike with all objects in the world and with all as instances.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <vector>

#include "runtime/render/renderer.hpp"
#include "runtime/scene/predicates.hpp"
#include "tests/pictures/small_scene.hpp"
#include "tests/support/exhaustive.hpp"
#include "tests/support/shared_device.hpp"

namespace voxelume {
namespace {

/// The scene with objects placed so, as far as they can be.
Scene placed_scene(const std::string& name, Placement placement) {
    Scene scene = small_scene(name, {128, 96}, 96);
    for (Object& object : scene.objects)
        object.placement = placement == Placement::instance && can_be_instance(scene, object)
                               ? Placement::instance
                               : Placement::world;
    return scene;
}

/// How far two images of a scene are apart.
struct PlacementDifference {
    double other_object = 0;  ///< share of the pixels that show another object
    double far = 0;           ///< share whose depth differs by more than half a voxel
    double color = 0;         ///< mean of all channels
    double light = 0;         ///< of the means of all channels, as a share of them
};

PlacementDifference difference_of(const std::string& name) {
    RenderReport report;
    const Scene scene = placed_scene(name, Placement::world);
    const Image world = render(shared_device(), scene, report);
    const Image instances =
        render(shared_device(), placed_scene(name, Placement::instance), report);
    EXPECT_GT(report.world.instances.instances, 0u);
    const glm::dvec3& edge = scene.world.voxel_size;
    const double voxel = std::max({edge.x, edge.y, edge.z});
    PlacementDifference difference;
    double all = 0;
    const size_t pixels = world.planes.at("Z").size();
    for (size_t i = 0; i < pixels; ++i) {
        const bool same =
            world.id_planes.at("objectId")[i] == instances.id_planes.at("objectId")[i];
        const double depth = double(world.planes.at("Z")[i]) - double(instances.planes.at("Z")[i]);
        difference.other_object += !same;
        difference.far += same && std::abs(depth) > 0.5 * voxel;
        for (const char* channel : {"R", "G", "B"}) {
            const double before = double(world.planes.at(channel)[i]),
                         after = double(instances.planes.at(channel)[i]);
            difference.color += std::abs(after - before) / 3;
            all += before, difference.light += after - before;
        }
    }
    difference.light = std::abs(difference.light) / all;
    difference.other_object /= double(pixels);
    difference.far /= double(pixels);
    difference.color /= double(pixels);
    return difference;
}

// The light samples of a lamp are others in its model's voxels. voxels.json is left out: an
// instance keeps its model's cubes, turned with it, while the world shows those of its own lattice
// that they become, and outlines of both are up to two voxels of that lattice apart. So is
// cubes.json. Global light (cornell, daylight, still_life) is noise at few samples.
TEST(ShippedPlacements, LookAlikeInTheWorldAndAsInstances) {
    std::vector<const char*> names = {"bunny", "solids", "lamp"};
    if (is_exhaustive())
        names.insert(names.end(), {"pendulum", "drill", "whitted", "prism", "stained_glass", "fog",
                                   "turntable", "melt", "procession"});
    for (const char* name : names) {
        const PlacementDifference found = difference_of(name);
        EXPECT_LT(found.other_object, 0.001) << name;
        EXPECT_LT(found.far, 0.001) << name;
        // Fog shows the light of other samples of its lamp in all of the hall.
        EXPECT_LT(found.color, std::string(name) == "fog" ? 0.02 : 0.005) << name;
    }
}

/// The scene of cornell.json in direct light, whose walls' outer faces lie on the world's bounds.
/// Where walls cross, both faces are at one depth, and either may be seen.
TEST(ShippedPlacements, OfWallsOnTheWorldsBoundsLookAlike) {
    const auto picture = [](Placement placement) {
        Scene scene = placed_scene("cornell", placement);
        scene.render.light = LightMode::local;
        scene.render.samples = 1;
        RenderReport report;
        return render(shared_device(), scene, report);
    };
    const Image world = picture(Placement::world), instances = picture(Placement::instance);
    for (size_t i = 0; i < world.planes.at("Z").size(); ++i) {
        const float depth = world.planes.at("Z")[i];
        if (std::isinf(depth)) {
            EXPECT_TRUE(std::isinf(instances.planes.at("Z")[i])) << i;
            continue;
        }
        EXPECT_NEAR(instances.planes.at("Z")[i], depth, 1e-5) << i;
    }
}

// A rough surface of glass bends rays so much that the least difference of normals leads them
// elsewhere. Pixels differ, and their mean doesn't.
TEST(ShippedPlacements, OfGlassInASmoothMeshHaveTheSameLightOnAverage) {
    const PlacementDifference found = difference_of("glass_bunny");
    EXPECT_LT(found.other_object, 0.002);
    EXPECT_LT(found.far, 0.001);
    EXPECT_LT(found.light, 0.01);
}

}  // namespace
}  // namespace voxelume
