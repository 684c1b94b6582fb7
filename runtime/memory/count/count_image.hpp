// SPDX-License-Identifier: Apache-2.0
// scene + world on a counting device -> the memory for its flat image.
#pragma once

#include "runtime/scene/scene.hpp"
#include "runtime/stages/light/light_tree.hpp"
#include "runtime/stages/medium/density_grid.hpp"
#include "runtime/stages/resolve/matte.hpp"
#include "runtime/stages/resolve/resolve.hpp"
#include "runtime/stages/trace/beam.hpp"
#include "runtime/stages/trace/ray_arrays.hpp"

namespace voxelume {

/// The buffers with which an image is made.
struct ImageMemory {
    RayArrays rays;
    DilatedOccupancy dilated_occupancy;
    Buffer<uint32_t> beams;
    std::vector<Buffer<float>> light_beams;
    std::vector<LightTree> light_trees;
    double light_tree_host_bytes = 0;  ///< main memory while they are made
    DensityGrid density;
    Buffer<uint8_t> tables;  ///< tables of materials, objects and samples
    Buffer<uint8_t> emitters;
    double emitter_host_bytes = 0;  ///< main memory while emitters are listed
    Buffer<uint8_t> sky_texels, sky_table;
    double sky_host_bytes = 0;  ///< main memory for the sky's picture
    ImageArrays image;
    std::vector<MatteArrays> mattes;
    ImageArrays first_image;  ///< arrays of the first samples of an adaptive image
    std::vector<MatteArrays> first_mattes;
    Buffer<uint32_t> chosen_pixels;  ///< pixels with further samples
};

/// All buffers of Renderer's image of a world, without the world. `depth` is that of the arrays for
/// reflections and refractions.
ImageMemory count_image(const Device& device, const Scene& scene, const Pyramid& world,
                        const DensityPlan& medium, size_t depth);

/// The small tables for light.
Buffer<uint8_t> count_tables(const Device& device, const Scene& scene);

/// The buffers of the dilated occupancy of a world.
DilatedOccupancy count_dilated_occupancy(const Device& device, const Pyramid& world,
                                         DilationLevel of);

}  // namespace voxelume
