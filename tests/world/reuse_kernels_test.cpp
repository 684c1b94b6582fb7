// SPDX-License-Identifier: Apache-2.0
// The work that each kind of change causes: exactly these kernels, and this many of the world's
// bricks.
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include "runtime/analysis/scene_choices.hpp"
#include "runtime/assets/voxel_export.hpp"
#include "runtime/io/mesh/mesh_reader.hpp"
#include "runtime/render/renderer.hpp"
#include "runtime/render/volume_renderer.hpp"
#include "runtime/stages/voxelize/voxelize.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/support/shared_device.hpp"
#include "tests/world/reuse_fixture.hpp"

namespace voxelume {
namespace {

constexpr const char* kDensity =
    R"("medium": {"density": {"kind": "height", "base": -0.2, "scale_height": 0.5}, )";
constexpr const char* kNumberedVoxels =
    R"("plain": {"voxels": "gem.#.vxm", "surface": "smooth", "sequence": {"first": 1, "last": 2}})";
constexpr const char* kRedBall = R"("model": "ball", "material": "red")";
constexpr const char* kFogBall = R"("model": "ball", "material": "fog")";

class ReuseKernels : public ReusedFrames, public testing::WithParamInterface<Change> {};

std::string text_of(const Kernels& kernels) {
    std::string text;
    for (const std::string& kernel : kernels) text += "\"" + kernel + "\", ";
    return text;
}

uint64_t hash_of_render(const Scene& scene) {
    RenderReport report;
    return oracle::image_hash(render(shared_device(), scene, report));
}

/// Writes the voxels of gem.N.obj as gem.N.vxm.
void voxelize_gem(const std::filesystem::path& folder, int number) {
    const std::string name = fmt::format("gem.{}", number);
    const Mesh mesh = read_mesh(folder / (name + ".obj"));
    const BrickGrid grid =
        voxelize_mesh(shared_device(), mesh, glm::dmat4(1), frame_around(mesh, glm::dvec3(0.05)),
                      {Surface::smooth, VoxelSet::supercover});
    VoxelExport(grid, mesh, Surface::smooth, VoxelSet::supercover)
        .write_model(folder / (name + ".vxm"));
}

TEST_P(ReuseKernels, AreThoseThatTheChangeReaches) {
    const Change& change = GetParam();
    if (change.by == kNumberedVoxels)
        for (const int number : {1, 2}) voxelize_gem(folder, number);
    Scene moving = scene(change);
    AssetStore meshes;
    make_choices(moving, meshes);
    WorldBuilder builder(shared_device());
    Renderer renderer(shared_device());
    for (const int frame : {1, 2}) {
        const Scene now = scene_at(moving, frame);
        std::map<std::string, uint64_t>& launches = shared_device().counters().launches;
        launches.clear();
        RenderReport report;
        const BuiltWorld world = builder.build(now, report.world);
        const uint64_t hash = oracle::image_hash(*renderer.image(now, world, report));
        Kernels kernels;
        for (const auto& [name, count] : launches) kernels.insert(name);
        EXPECT_EQ(hash, hash_of_render(now)) << "frame " << frame;
        if (frame == 1) continue;
        EXPECT_EQ(text_of(kernels), text_of(change.kernels));
        EXPECT_EQ(int(report.world.change), int(change.world));
        EXPECT_EQ(report.is_kept, change.kernels.empty());
        EXPECT_EQ(report.hits_are_kept, change.hits_are_kept);
        EXPECT_EQ(report.world.voxelized, change.voxelized);
        EXPECT_EQ(report.world.painted_bricks, change.painted_bricks);
        EXPECT_EQ(report.world.instances.moved, change.instances_moved);
    }
}

TEST_F(ReusedFrames, LeaveTheMeshOfACutThatStoodStillAlone) {
    const Change still{"", "lights.sun.intensity", "20", "20", {}};
    Scene now = scene(still);
    WorldBuilder builder(shared_device());
    WorldReport report;
    builder.build(now, report);
    now.objects[0].world_from_object[3].x += 0.8;
    builder.build(now, report);
    now.models[7].cuts[0].radius = 0.12;
    WorldReport last;
    builder.build(now, last);
    EXPECT_EQ(last.voxelized, 1u);
}

TEST_F(ReusedFrames, HaveAStillVolumeForNothing) {
    const Change change{"", "lights.sun.intensity", "20", "30", {}};
    const Scene moving = scene(change);
    WorldBuilder builder(shared_device());
    VolumeRenderer renderer(shared_device());
    std::shared_ptr<const Volume> before;
    RenderReport first;
    for (const int frame : {1, 0, 2}) {
        const Scene now = scene_at(moving, frame);
        shared_device().counters().launches.clear();
        RenderReport report;
        const BuiltWorld world = builder.build(now, report.world);
        const std::shared_ptr<const Volume> volume = renderer.volume(now, world, report);
        if (frame == 0) {
            EXPECT_EQ(volume, before);
            EXPECT_THAT(shared_device().counters().launches, testing::IsEmpty());
            EXPECT_EQ(report.sight_rays, first.sight_rays);
        }
        EXPECT_EQ(report.is_kept, frame == 0);
        first = report;
        if (frame == 2) {
            EXPECT_NE(volume->colors, before->colors);
        }
        before = volume;
    }
}

INSTANTIATE_TEST_SUITE_P(
    Changes, ReuseKernels,
    testing::Values(
        Change{"Nothing", "lights.sun.intensity", "20", "20", {}, WorldChange::none, true},
        Change{"LightPosition", "lights.sun.position", "[1, 3, -3]", "[0, 3, -3]", kShade,
               WorldChange::none, true},
        Change{"LightEnergy", "lights.sun.intensity", "20", "30", kShade, WorldChange::none, true},
        Change{"LightRadius", "lights.disk.radius", "0.3", "0.5", kShade, WorldChange::none, true},
        Change{"Emission", "materials.glow.emission", "[3, 2, 1]", "[1, 2, 3]", kShade,
               WorldChange::none, true},
        Change{"MaterialColor", "materials.red.color", "[0.8, 0.2, 0.2]", "[0.2, 0.8, 0.2]", kShade,
               WorldChange::none, true},
        Change{"Medium", "world.medium.absorption", "[0.05, 0.02, 0.01]", "[0.1, 0.2, 0.3]", kShade,
               WorldChange::none, true},
        Change{"Background", "world.background", "[0.2, 0.3, 0.5]", "[0.5, 0.3, 0.2]", kShade,
               WorldChange::none, true},
        Change{"Ambient", "world.ambient", "[0.1, 0.1, 0.1]", "[0.2, 0.1, 0.3]", kShade,
               WorldChange::none, true},
        Change{"ObserverPosition", "observer.position", "[0, 0.3, -5]", "[0.2, 0.3, -5]", kTrace},
        Change{"ObserverTurn", "observer.turn", "[0, 2, 0]", "[3, 2, 1]", kTrace},
        Change{"Sector", "observer.display.angles", "[50, 40]", "[30, 20]", kTrace},
        Change{"DisplayDepth", "observer.display.far", "20", "5", kTrace},
        Change{"Instance", "objects.cone.position", "[1.2, 0.4, 1.2]", "[0, 0.4, 1.2]", kTrace,
               WorldChange::instances, false, 0, 0, 1},
        Change{"InstanceTurn", "objects.cone.turn", "[0, 0, 0]", "[10, 20, 30]", kTrace,
               WorldChange::instances, false, 0, 0, 1},
        Change{"InstanceScale", "objects.cone.scale", "1", "1.5", kTrace, WorldChange::instances,
               false, 0, 0, 1},
        Change{"InstanceMaterial", "objects.cone.material", "\"red\"", "\"blue\"", kJoin,
               WorldChange::built, false, 0, 0},
        Change{"InstanceGoes", "objects.cone.visible", "true", "false", kJoin, WorldChange::built,
               false, 0, 0},
        Change{"InstanceComes", "objects.cone.visible", "false", "true", kJoin, WorldChange::built,
               false, 0, 0, 1},
        Change{"InstanceModel", "models.cone.radius", "0.2", "0.15",
               all_of({kJoin,
                       {"sample_solid", "classify_solid_bricks", "mark_voxels", "write_voxels"}}),
               WorldChange::built, false, 1, 0},
        Change{"Smooth", "objects.ball.position", "[-2.4, 0, -2.4]", "[-1.6, 0, -2.4]", kSmooth,
               WorldChange::built, false, 0, 8},
        Change{"SmoothTurn", "objects.gem.turn", "[0, 0, 0]", "[90, 0, 0]", kSmooth,
               WorldChange::built, false, 0, 8},
        Change{"SmoothScale", "objects.ball.scale", "1", "0.5",
               all_of({kNewSmooth, {"classify_solid_bricks", "sample_solid"}}), WorldChange::built,
               false, 1, 8},
        Change{"SmoothScaleALittle", "objects.ball.scale", "0.95", "0.9", kSmooth,
               WorldChange::built, false, 0, 8},
        Change{"EmissiveObject", "objects.lamp.position", "[0.8, 0, -0.8]", "[1.6, 0, -0.8]",
               kSmooth, WorldChange::built, false, 0, 8},
        Change{"Cubes", "objects.block.position", "[2, -0.4, -2]", "[2.4, -0.4, -2]", kCubes,
               WorldChange::built, false, 0, 2},
        Change{"Exact", "objects.stone.position", "[-2.4, 0, 0.8]", "[-2.4, 0, 1.6]", kNewExact,
               WorldChange::built, false, 1, 8},
        Change{"Goes", "objects.ball.visible", "true", "false", kUnite, WorldChange::built, false,
               0, 0},
        Change{"Comes", "objects.ball.visible", "false", "true", kSmooth, WorldChange::built, false,
               0, 8},
        Change{"Material", "objects.ball.material", "\"red\"", "\"blue\"", kSmooth,
               WorldChange::built, false, 0, 8},
        Change{"ModelSwap", "objects.ball.model", "\"ball\"", "\"small\"",
               all_of({kNewSmooth, {"classify_solid_bricks", "sample_solid"}}), WorldChange::built,
               false, 1, 8},
        Change{"Measure", "models.block.size", "[0.4, 0.3, 0.2]", "[0.3, 0.3, 0.2]", kNewCubes,
               WorldChange::built, false, 1, 1},
        Change{"ExactMeasure", "models.stone.radii", "[0.3, 0.2, 0.25]", "[0.2, 0.2, 0.25]",
               kNewExact, WorldChange::built, false, 1, 8},
        Change{"NumberedMesh", "models.plain.mesh", "\"gem.1.obj\"", "\"gem.2.obj\"", kNewMesh,
               WorldChange::built, false, 1, 8},
        Change{"Morph", "models.gem.morph.amount", "0", "0.5", kNewMesh, WorldChange::built, false,
               1, 8},
        Change{"MediumDensity", "world.medium.density.base", "-0.2", "0.2", kShade,
               WorldChange::none, true, 0, 0, 0, "\"medium\": {", kDensity},
        Change{"MediumDensityScale", "world.medium.density.scale_height", "0.5", "0.2", kShade,
               WorldChange::none, true, 0, 0, 0, "\"medium\": {", kDensity},
        Change{"LookAt", "observer.look_at", "[0, 0, 0]", "[0.3, 0.1, 0]", kTrace,
               WorldChange::none, false, 0, 0, 0, "\"turn\": [0, 2, 0]", "\"look_at\": [0, 0, 0]"},
        Change{"Up", "observer.up", "[0, 1, 0]", "[0.2, 1, 0]", kTrace, WorldChange::none, false, 0,
               0, 0, "\"turn\": [0, 2, 0]", "\"look_at\": [0, 0, 0], \"up\": [0, 1, 0]"},
        Change{
            "NumberedVoxels", "lights.sun.intensity", "20", "20", kNewSmooth, WorldChange::built,
            false, 1, 8, 0,
            "\"plain\": {\"mesh\": \"gem.1.obj\", \"voxel_size\": 0.05, \"surface\": \"smooth\"}",
            kNumberedVoxels},
        Change{"InstanceModelSwap", "objects.cone.model", "\"cone\"", "\"small\"",
               all_of({kJoin,
                       {"sample_solid", "classify_solid_bricks", "mark_voxels", "write_voxels"}}),
               WorldChange::built, false, 1, 0},
        Change{"OpacityBelow1", "materials.fog.opacity", "1", "0.5", kPaths, WorldChange::built,
               false, 0, 0, 0, kRedBall, kFogBall},
        Change{"OpacityAgain1", "materials.fog.opacity", "0.5", "1", kJoin, WorldChange::built,
               false, 0, 0, 0, kRedBall, kFogBall},
        Change{"ReflectionAbove0", "materials.fog.reflection", "0", "0.5",
               all_of({kTrace, {"begin_paths", "scatter_rays"}}), WorldChange::none, false, 0, 0, 0,
               kRedBall, kFogBall},
        Change{"ReflectionAgain0", "materials.fog.reflection", "0.5", "0", kTrace,
               WorldChange::none, false, 0, 0, 0, kRedBall, kFogBall},
        Change{"AbsorptionAbove0", "world.medium.absorption", "[0, 0, 0]", "[0.1, 0.2, 0.1]",
               kShade, WorldChange::none, true},
        Change{"EmissionAbove0", "materials.fog.emission", "[0, 0, 0]", "[1, 2, 1]", kShade,
               WorldChange::none, true, 0, 0, 0, kRedBall, kFogBall},
        Change{"EmissionAgain0", "materials.fog.emission", "[1, 2, 1]", "[0, 0, 0]", kShade,
               WorldChange::none, true, 0, 0, 0, kRedBall, kFogBall},
        Change{"Cut", "models.drilled.cut[0].radius", "0.1", "0.12",
               all_of({kNewSmooth, {"classify_solid_bricks", "sample_solid"}}), WorldChange::built,
               false, 1, 16}),
    [](const auto& change) { return std::string(change.param.name); });

}  // namespace
}  // namespace voxelume
