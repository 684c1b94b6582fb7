// What each kind of change makes anew: exactly these kernels, and this many of the world's bricks.
//
// Bricks are 0.8 m. All objects but one stand where eight of them meet, and are so small that these
// are all that they have a part in, wherever they go; a brick that nothing is left in isn't painted
// but dropped. The block stands in the middle of one, and goes to where two meet.
#include <fmt/format.h>
#include <gmock/gmock.h>
#include <gtest/gtest.h>

#include <set>

#include "runtime/renderer.hpp"
#include "runtime/scene_animation.hpp"
#include "runtime/volume_renderer.hpp"
#include "tests/file_fixture.hpp"
#include "tests/oracles/image_hash.hpp"
#include "tests/shared_device.hpp"

namespace voxelume {
namespace {

using Kernels = std::set<std::string>;

constexpr const char* kScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-3.2, -0.8, -3.2], "max": [3.2, 0.8, 3.2]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.1, 0.1],
          "medium": {"absorption": [0.05, 0.02, 0.01]}},
"materials": {"red": {"color": [0.8, 0.2, 0.2]}, "blue": {"color": [0.2, 0.2, 0.8]},
              "glow": {"emission": [3, 2, 1]}},
"models": {"ball": {"shape": "sphere", "radius": 0.2},
           "small": {"shape": "sphere", "radius": 0.15},
           "block": {"shape": "box", "size": [0.4, 0.3, 0.2], "surface": "cubes", "set": "solid"},
           "stone": {"shape": "ellipsoid", "radii": [0.3, 0.2, 0.25], "surface": "exact"},
           "cone": {"shape": "cone", "radius": 0.2, "height": 0.5},
           "gem": {"mesh": "gem.1.obj", "morph": {"center": [0, 0, 0], "radius": 0.2, "amount": 0}, "voxel_size": 0.05},
           "plain": {"mesh": "gem.1.obj", "voxel_size": 0.05},
           "drilled": {"mesh": "gem.1.obj", "voxel_size": 0.05,
                       "cut": [{"shape": "sphere", "radius": 0.1, "position": [0.1, 0, 0]}]}},
"objects": [
  {"name": "ball", "model": "ball", "material": "red", "placement": "world",
   "position": [-2.4, 0, -2.4]},
  {"name": "block", "model": "block", "material": "blue", "placement": "world",
   "position": [2, -0.4, -2]},
  {"name": "stone", "model": "stone", "material": "red", "placement": "world",
   "position": [-2.4, 0, 0.8]},
  {"name": "gem", "model": "gem", "material": "blue", "placement": "world",
   "position": [-0.8, 0, -0.8]},
  {"name": "plain", "model": "plain", "material": "blue", "placement": "world",
   "position": [-0.8, 0, 2.4]},
  {"name": "drilled", "model": "drilled", "material": "red", "placement": "world",
   "position": [0.8, 0, 0.8]},
  {"name": "lamp", "model": "ball", "material": "glow", "placement": "world", "spots": 8,
   "position": [0.8, 0, -0.8]},
  {"name": "cone", "model": "cone", "material": "red", "placement": "instance",
   "position": [1.2, 0.4, 1.2]},
  {"name": "other cone", "model": "cone", "material": "blue", "placement": "instance",
   "position": [1.2, -0.3, 1.2]}],
"lights": [{"name": "sun", "type": "point", "position": [1, 3, -3], "intensity": 20},
           {"name": "disk", "type": "disk", "position": [0, 3, 0], "direction": [0, -1, 0.1],
            "radius": 0.3, "intensity": 5, "spots": 4}],
"observer": {"position": [0, 0.3, -5], "turn": [0, 2, 0],
             "display": {"shape": "pyramid", "angles": [50, 40], "near": 0.5, "far": 20,
                         "voxels": [8, 8, 8]}},
"render": {"size": [64, 48], "depth": 2},
"animation": {"frames": 2, "tracks": [{"target": "TARGET", "interpolation": "step",
    "keys": [{"frame": 1, "value": FROM}, {"frame": 2, "value": TO}]}]}})";

/// A closed octahedron with corners at six different distances.
std::string gem(double top) {
    return fmt::format(
        "v 0.2 0 0\nv -0.25 0 0\nv 0 {} 0\nv 0 -0.15 0\nv 0 0 0.22\nv 0 0 -0.18\n"
        "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n",
        top);
}

/// A value of the scene that changes from the first to the second frame, and what follows.
struct Change {
    const char* name;
    const char* target;
    const char* from;
    const char* to;
    Kernels kernels;
    WorldChange world = WorldChange::none;
    bool hits_are_kept = false;
    uint64_t voxelized = 0, painted_bricks = 0;
    uint32_t instances_moved = 0;
};

Kernels all_of(std::initializer_list<Kernels> parts) {
    Kernels all;
    for (const Kernels& part : parts) all.insert(part.begin(), part.end());
    return all;
}

// The lamp's spots are found anew with the light.
const Kernels kShade = {"absorb_shadows", "absorb_sight",   "add_light",     "find_surface",
                        "list_glowing",   "resolve_pixels", "shade_surface", "trace_shadows"};
const Kernels kTrace = all_of({kShade, {"cast_sight", "trace_closest"}});
// The models of instances behind the world's voxels.
const Kernels kJoin = all_of(
    {kTrace,
     {"append_bricks", "append_copies", "append_numbers", "append_primitives", "append_words"}});
// Bricks, the lists of the exact objects in them, and what rays read of them.
const Kernels kEmpty = all_of({kJoin,
                               {"classify_bricks", "count_primitives", "sum_counts", "start_lists",
                                "set_solid_attributes", "mark_voxels", "write_voxels"}});
const Kernels kCubes = all_of({kEmpty, {"clear_bricks", "close_distances", "paint_cubes"}});
const Kernels kSmooth = all_of({kCubes, {"paint_distances", "paint_smooth_voxels"}});
const Kernels kNewCubes = all_of({kCubes, {"occupy_solid", "mark_near_leaves"}});
const Kernels kNewExact = all_of({kNewCubes, {"count_voxels", "number_voxels"}});
const Kernels kNewSmooth = all_of({kSmooth, {"mark_near_leaves"}});
const Kernels kNewMesh = all_of({kNewSmooth,
                                 {"carry_rows", "count_crossings", "count_pairs", "find_inside",
                                  "list_pairs", "measure_distances", "shape_triangles"}});

class ReusedFrames : public FileTest {
  protected:
    Scene scene(const Change& change) {
        put_bytes(folder / "gem.1.obj", gem(0.2));
        put_bytes(folder / "gem.2.obj", gem(0.12));
        std::string text = kScene;
        const auto put = [&](const std::string& place, const char* value) {
            text.replace(text.find(place), place.size(), value);
        };
        put("TARGET", change.target);
        put("FROM", change.from);
        put("TO}", (change.to + std::string("}")).c_str());
        return parse_scene(text, folder / "scene.json", {});
    }
};

class ReuseKernels : public ReusedFrames, public testing::WithParamInterface<Change> {};

/// For the name of a test.
void PrintTo(const Change& change, std::ostream* out) {
    *out << change.name;
}

std::string text_of(const Kernels& kernels) {
    std::string text;
    for (const std::string& kernel : kernels) text += "\"" + kernel + "\", ";
    return text;
}

uint64_t hash_alone(const Scene& scene) {
    RenderReport report;
    return oracle::image_hash(render(shared_device(), scene, report));
}

TEST_P(ReuseKernels, AreThoseThatTheChangeReaches) {
    const Change& change = GetParam();
    const Scene moving = scene(change);
    WorldFormer former(shared_device());
    Renderer renderer(shared_device());
    for (const int frame : {1, 2}) {
        const Scene now = scene_at(moving, frame);
        std::map<std::string, uint64_t>& launches = shared_device().counters().launches;
        launches.clear();
        RenderReport report;
        const FormedWorld world = former.form(now, report.world);
        const uint64_t hash = oracle::image_hash(*renderer.image(now, world, report));
        Kernels kernels;
        for (const auto& [name, count] : launches) kernels.insert(name);
        EXPECT_EQ(hash, hash_alone(now)) << "frame " << frame;
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
    WorldFormer former(shared_device());
    WorldReport report;
    former.form(now, report);
    now.objects[0].world_from_object[3].x += 0.8;
    former.form(now, report);
    now.models[7].cuts[0].radius = 0.12;
    WorldReport last;
    former.form(now, last);
    EXPECT_EQ(last.voxelized, 1u);
}

TEST_F(ReusedFrames, HaveAStillVolumeForNothing) {
    const Change change{"", "lights.sun.intensity", "20", "30", {}};
    const Scene moving = scene(change);
    WorldFormer former(shared_device());
    VolumeRenderer renderer(shared_device());
    std::shared_ptr<const Volume> before;
    RenderReport first;
    for (const int frame : {1, 0, 2}) {
        const Scene now = scene_at(moving, frame);
        shared_device().counters().launches.clear();
        RenderReport report;
        const FormedWorld world = former.form(now, report.world);
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
        Change{"LampEmission", "materials.glow.emission", "[3, 2, 1]", "[1, 2, 3]", kShade,
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
               WorldChange::formed, false, 0, 0},
        Change{"InstanceGoes", "objects.cone.visible", "true", "false", kJoin, WorldChange::formed,
               false, 0, 0},
        Change{"InstanceComes", "objects.cone.visible", "false", "true", kJoin, WorldChange::formed,
               false, 0, 0, 1},
        Change{"InstanceModel", "models.cone.radius", "0.2", "0.15",
               all_of({kJoin, {"sample_solid", "classify_bricks", "mark_voxels", "write_voxels"}}),
               WorldChange::formed, false, 1, 0},
        Change{"Smooth", "objects.ball.position", "[-2.4, 0, -2.4]", "[-1.6, 0, -2.4]", kSmooth,
               WorldChange::formed, false, 0, 8},
        Change{"SmoothTurn", "objects.gem.turn", "[0, 0, 0]", "[90, 0, 0]", kSmooth,
               WorldChange::formed, false, 0, 8},
        Change{"SmoothScale", "objects.ball.scale", "1", "0.5", kNewSmooth, WorldChange::formed,
               false, 0, 8},
        Change{"Lamp", "objects.lamp.position", "[0.8, 0, -0.8]", "[1.6, 0, -0.8]", kSmooth,
               WorldChange::formed, false, 0, 8},
        Change{"Cubes", "objects.block.position", "[2, -0.4, -2]", "[2.4, -0.4, -2]", kCubes,
               WorldChange::formed, false, 0, 2},
        Change{"Exact", "objects.stone.position", "[-2.4, 0, 0.8]", "[-2.4, 0, 1.6]", kNewExact,
               WorldChange::formed, false, 1, 8},
        Change{"Goes", "objects.ball.visible", "true", "false",
               all_of({kEmpty, {"move_bricks", "move_masks"}}), WorldChange::formed, false, 0, 0},
        Change{"Comes", "objects.ball.visible", "false", "true", kSmooth, WorldChange::formed,
               false, 0, 8},
        Change{"Material", "objects.ball.material", "\"red\"", "\"blue\"", kSmooth,
               WorldChange::formed, false, 0, 8},
        Change{"ModelSwap", "objects.ball.model", "\"ball\"", "\"small\"",
               all_of({kNewSmooth, {"sample_solid"}}), WorldChange::formed, false, 1, 8},
        Change{"Measure", "models.block.size", "[0.4, 0.3, 0.2]", "[0.3, 0.3, 0.2]", kNewCubes,
               WorldChange::formed, false, 1, 1},
        Change{"ExactMeasure", "models.stone.radii", "[0.3, 0.2, 0.25]", "[0.2, 0.2, 0.25]",
               kNewExact, WorldChange::formed, false, 1, 8},
        Change{"NumberedMesh", "models.plain.mesh", "\"gem.1.obj\"", "\"gem.2.obj\"", kNewMesh,
               WorldChange::formed, false, 1, 8},
        Change{"Morph", "models.gem.morph.amount", "0", "0.5", kNewMesh, WorldChange::formed, false,
               1, 8},
        Change{"Cut", "models.drilled.cut[0].radius", "0.1", "0.12",
               all_of({kNewSmooth, {"sample_solid", "join_distances"}}), WorldChange::formed, false,
               1, 8}),
    [](const auto& change) { return std::string(change.param.name); });

}  // namespace
}  // namespace voxelume
