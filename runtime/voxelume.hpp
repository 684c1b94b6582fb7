// SPDX-License-Identifier: Apache-2.0
// Voxelume: images of voxel worlds, flat and volumetric, by discrete ray tracing in OpenCL.
//
// This header is the library; it includes the parts below voxelume/, each of which is the manual of
// its subject. A program finds it with CMake by `find_package(voxelume)` and links the target
// `voxelume::voxelume`, or by `pkg-config --cflags --libs voxelume`. C++20 is needed.
//
// Example: a ball hovers over a box, in the light of one point light; ten frames as PNG files.
//
//     #include <voxelume.hpp>
//
//     int main() {
//         using namespace voxelume;
//         SceneDescription room;
//         room.world = {.voxel_size = uniform(0.02), .min = {-1, 0, -1}, .max = {1, 2, 1},
//                       .ambient = {0.1, 0.1, 0.1}};
//         room.materials = {{.name = "red", .color = {0.8, 0.1, 0.1}}};
//         room.models = {{.name = "ball", .source = Sphere{0.3}},
//                        {.name = "box", .source = Box{{1.2, 0.4, 1.2}}}};
//         room.objects = {{.name = "ball", .model = "ball", .material = "red"},
//                         {.model = "box", .position = {0, 0.2, 0}}};
//         room.lights = {{.source = PointLight{{1, 1.9, 0.9}}, .intensity = 3}};
//         room.observer = {.position = {0.5, 1.6, 3}, .look_at = Vec3{0, 0.7, 0}};
//         room.animation = {.frames = 10, .tracks = {{"objects.ball.position",
//                           Keys<Vec3>{{1, {0, 0.8, 0}}, {10, {0, 1.4, 0}}}}}};
//         const Scene scene = Scene::build(room);
//         const std::vector<Device> devices = Device::open_all("auto");
//         FrameJob job;
//         for (int n = 1; n <= 10; ++n)
//             job.frames.push_back({.frame = n, .images = {frame_path("room.##.png", n, true)}});
//         render_frames(scene, devices, job);
//     }
//
// | I want to                          | Call                                      | Part        |
// | ---------------------------------- | ----------------------------------------- | ----------- |
// | know what can render here          | list_devices, Device::open                | device.hpp  |
// | have a scene                       | Scene::load, Scene::parse, Scene::build   | scene.hpp   |
// | show a model file without a scene  | scene_of_file, import_file                | import.hpp  |
// | show voxels that are in memory     | scene_of_voxels, SceneOptions::voxels     | import.hpp  |
// | know whether it fits               | plan                                      | plan.hpp    |
// | have one image or volume in memory | render_image, render_volume               | render.hpp  |
// | render many frames, or to files    | render_frames                             | render.hpp  |
// | read, write and compare images     | Image::read, Image::write, compare        | image.hpp   |
// | read, write and view volumes       | Volume::read, Volume::write, Volume::view | volume.hpp  |
// | have views for a light field       | render_quilt                              | render.hpp  |
// | turn a mesh or scene into voxels   | voxelize, voxelize_scene, describe_file   | files.hpp   |
//
// Units. Lengths are metres, angles degrees, colours linear Rec. 709, radiance is in the scene's
// own units. Axes are right-handed with Y up.
//
// Errors. A call that fails throws `Error`, whose sentence is for people and whose parts (kind,
// file, line, column, key) are for programs. After that, all objects are as they were before. In
// comments, "Error::usage" is short for an Error whose kind is ErrorKind::usage.
//
// Warnings. What is probably wrong and stops nothing, as an object outside the world, is in
// Statistics::warnings and Plan::warnings; RenderOptions::warn hears of it, RenderOptions::strict
// makes errors of it.
//
// Ownership. Scene, Device, Image and Volume are handles: a copy costs a pointer and shares what
// it stands for. Spans point into an Image or Volume and live as long as it or a copy does.
//
// Threads. Scenes, images and volumes never change and may be used by any number of threads. A
// device serves one call at a time. Rendering starts threads of its own and ends them before it
// returns.
//
// The process. The library prints nothing, ends no process, sets no environment variable and starts
// no process, unless `configure` allows it (process.hpp). It reads the variables VOXELUME_DEVICE,
// VOXELUME_ASSETS, VOXELUME_CACHE_DIR, VOXELUME_CACHE_MB, VOXELUME_MEMORY_MB, VOXELUME_BUFFER_MB,
// VOXELUME_LANES, VOXELUME_UNITS, VOXELUME_BATCH, VOXELUME_WORK_GROUP, VOXELUME_BUILD_OPTIONS and
// VOXELUME_SELF_TEST, which cli/MANUAL.md explains, and XDG_CACHE_HOME and HOME; also, where
// `configure` allows its setting, POCL_CACHE_DIR. It keeps compiled kernels, voxelized models and
// worlds in the user's cache.
//
// Bits. The same scene gives the same bits on every number of devices, lanes and threads, whatever
// was rendered before.
#pragma once

#include "voxelume/animation.hpp"
#include "voxelume/device.hpp"
#include "voxelume/error.hpp"
#include "voxelume/files.hpp"
#include "voxelume/image.hpp"
#include "voxelume/import.hpp"
#include "voxelume/lights.hpp"
#include "voxelume/objects.hpp"
#include "voxelume/observer.hpp"
#include "voxelume/plan.hpp"
#include "voxelume/process.hpp"
#include "voxelume/quilt.hpp"
#include "voxelume/render.hpp"
#include "voxelume/scene.hpp"
#include "voxelume/statistics.hpp"
#include "voxelume/values.hpp"
#include "voxelume/volume.hpp"
#include "voxelume/warning.hpp"
#include "voxelume/world.hpp"

#ifndef VOXELUME_BUILDING
/// `voxelume::v1` is the library's first binary interface; its names are visible in `voxelume`.
/// (The library's own sources have other types of the same names.)
namespace voxelume {
using namespace v1;  // NOLINT(google-build-using-namespace): all of them, for every caller
}
#endif
