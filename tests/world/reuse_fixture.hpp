// SPDX-License-Identifier: Apache-2.0
// A scene in which one value changes from the first to the second frame, and the kernels that each
// kind of change launches.
// Bricks are 0.8 m. All objects except one stand where eight bricks meet, and are so small that
// they only ever overlap these eight. A brick in which nothing is left is dropped and not painted.
// The block stands in the middle of one brick, and moves to where two meet.
#pragma once

#include <fmt/format.h>

#include <ostream>
#include <set>
#include <string>

#include "runtime/scene/scene_animation.hpp"
#include "runtime/scene_file/read_scene.hpp"
#include "runtime/world/world.hpp"
#include "tests/support/file_fixture.hpp"

namespace voxelume {

using Kernels = std::set<std::string>;

inline constexpr const char* kReusedScene = R"({"voxelume": 1,
"world": {"voxel_size": 0.05, "bounds": {"min": [-3.2, -0.8, -3.2], "max": [3.2, 0.8, 3.2]},
          "background": [0.2, 0.3, 0.5], "ambient": [0.1, 0.1, 0.1],
          "medium": {"absorption": [0.05, 0.02, 0.01]}},
"materials": {"red": {"color": [0.8, 0.2, 0.2]}, "blue": {"color": [0.2, 0.2, 0.8]},
              "glow": {"emission": [3, 2, 1]}, "fog": {"color": [0.8, 0.8, 0.8]}},
"models": {"ball": {"shape": "sphere", "radius": 0.2, "surface": "smooth"},
           "small": {"shape": "sphere", "radius": 0.15, "surface": "smooth"},
           "block": {"shape": "box", "size": [0.4, 0.3, 0.2], "surface": "cubes", "set": "solid"},
           "stone": {"shape": "ellipsoid", "radii": [0.3, 0.2, 0.25], "surface": "exact"},
           "cone": {"shape": "cone", "radius": 0.2, "height": 0.5, "surface": "smooth"},
           "gem": {"mesh": "gem.1.obj", "morph": {"center": [0, 0, 0], "radius": 0.2, "amount": 0}, "voxel_size": 0.05, "surface": "smooth"},
           "plain": {"mesh": "gem.1.obj", "voxel_size": 0.05, "surface": "smooth"},
           "drilled": {"mesh": "gem.1.obj", "voxel_size": 0.05,
                       "cut": [{"shape": "sphere", "radius": 0.1, "position": [0.1, 0, 0]}], "surface": "smooth"}},
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
inline std::string gem(double top) {
    return fmt::format(
        "v 0.2 0 0\nv -0.25 0 0\nv 0 {} 0\nv 0 -0.15 0\nv 0 0 0.22\nv 0 0 -0.18\n"
        "f 1 3 5\nf 3 2 5\nf 2 4 5\nf 4 1 5\nf 3 1 6\nf 2 3 6\nf 4 2 6\nf 1 4 6\n",
        top);
}

/// A value of the scene that changes from the first to the second frame, and the work that this
/// causes.
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
    const char* replaced = "";  ///< the text that is replaced in the scene
    const char* by = "";        ///< the text that replaces it
};

/// Prints the change in the name of a test.
inline void PrintTo(const Change& change, std::ostream* out) {
    *out << change.name;
}

inline Kernels all_of(std::initializer_list<Kernels> parts) {
    Kernels all;
    for (const Kernels& part : parts) all.insert(part.begin(), part.end());
    return all;
}

// The light samples of emissive objects are found again together with the light.
inline const Kernels kShade = {"absorb_shadows", "absorb_sight",  "add_light",
                               "find_surface",   "list_emissive", "resolve_pixels",
                               "shade_surface",  "trace_shadows"};
inline const Kernels kTrace = all_of({kShade, {"cast_sight", "trace_closest"}});
// Joins the models of instances to the world's voxels, some of which list fields.
inline const Kernels kJoin =
    all_of({kTrace,
            {"append_bricks", "append_copies", "append_fields", "append_numbers",
             "append_instance_primitives", "append_instance_words"}});
// Where something lets light through, rays continue, and shadow rays lose light where they are
// traced.
inline const Kernels kPaths = {"absorb_sight",
                               "add_light",
                               "append_bricks",
                               "append_fields",
                               "append_copies",
                               "append_numbers",
                               "append_instance_primitives",
                               "append_instance_words",
                               "begin_paths",
                               "cast_sight",
                               "find_surface",
                               "list_emissive",
                               "pass_layer",
                               "resolve_pixels",
                               "shade_surface",
                               "trace_closest",
                               "trace_shadows"};
// These kernels unite the fields of smooth objects with the other voxels; one object is a mesh that
// is cut.
inline const Kernels kUnite = all_of(
    {kJoin,
     {"append_masks", "mark_inside", "join_parts", "unite_marks", "write_fields", "write_united"}});
// Builds bricks of cubes and exact voxels, and the lists of the exact objects in them.
inline const Kernels kEmpty = all_of(
    {kUnite,
     {"classify_bricks", "count_primitives", "sum_counts", "start_lists", "set_solid_attributes"}});
inline const Kernels kCubes =
    all_of({kEmpty, {"append_primitives", "append_words", "clear_bricks", "paint_cubes"}});
// Builds the field of one object.
inline const Kernels kSmooth = all_of(
    {kUnite,
     {"classify_bricks", "clear_bricks", "close_distances", "mark_voxels", "paint_distances"}});
inline const Kernels kNewCubes =
    all_of({kCubes, {"classify_solid_bricks", "occupy_solid", "mark_near_leaves"}});
inline const Kernels kNewExact = all_of({kNewCubes, {"count_solid_voxels", "number_voxels"}});
inline const Kernels kNewSmooth = all_of({kSmooth, {"mark_near_leaves"}});
inline const Kernels kNewMesh =
    all_of({kNewSmooth,
            {"carry_rows", "count_crossings", "count_pairs", "find_inside", "list_pairs",
             "measure_distances", "shape_triangles"}});

class ReusedFrames : public FileTest {
  protected:
    void SetUp() override {
        FileTest::SetUp();
        put_bytes(folder / "gem.1.obj", gem(0.2));
        put_bytes(folder / "gem.2.obj", gem(0.12));
    }

    Scene scene(const Change& change) const {
        std::string text = kReusedScene;
        const auto put = [&](const std::string& place, const char* value) {
            const size_t at = text.find(place);
            ASSERT_NE(at, std::string::npos) << place;
            text.replace(at, place.size(), value);
        };
        if (*change.replaced) put(change.replaced, change.by);
        put("TARGET", change.target);
        put("FROM", change.from);
        put("TO}", (change.to + std::string("}")).c_str());
        return parse_scene(text, folder / "scene.json", {});
    }
};

}  // namespace voxelume
