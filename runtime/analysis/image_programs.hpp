// SPDX-License-Identifier: Apache-2.0
// scene -> the programs and kernels that its image is made by, known before its world is built.
#pragma once

#include <vector>

#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/features.hpp"

namespace voxelume {

/// The kernel files of the stages that sight rays pass through. `makes_image` says that the rays
/// end in a flat image of the scene's channels, `has_dilated_occupancy` that lights may send beams.
std::vector<const char*> sight_files(const Features& features, const Scene& scene,
                                     const Pyramid& world, bool makes_image,
                                     bool has_dilated_occupancy);

/// Those kernels of such files that most runs launch.
std::vector<ForeseenKernel> image_kernels(const std::vector<const char*>& files,
                                          const Features& features, bool has_dilated_occupancy);

/// The programs and kernels that the image of a scene is expected to need.
struct ForeseenImage {
    Features features;
    std::vector<const char*> files;
    std::vector<ForeseenKernel> kernels;
};

/// Foresees the programs of a scene's image. `world` may be one of a counting device, and has no
/// parts of solids. The result has no files where only building the world can tell whether several
/// surfaces share a voxel, and for images that are made in several ways one after another: with
/// passes, with a target of noise, adaptively, or of several moments.
ForeseenImage foreseen_image(const Scene& scene, const Pyramid& world);

/// Compiles the foreseen programs, or makes compiled ones ready, while the world is built; see
/// Program::foresee.
void compile_ahead(const Device& device, const RenderSettings& render, const ForeseenImage& image);

}  // namespace voxelume
