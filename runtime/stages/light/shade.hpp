// SPDX-License-Identifier: Apache-2.0
// hits -> surface points, and their radiance without lights.
#pragma once

#include "kernels/shared/scene.h"
#include "kernels/shared/sky.h"
#include "runtime/grid/grid.hpp"
#include "runtime/opencl/program.hpp"
#include "runtime/scene/scene.hpp"
#include "runtime/stages/emitter_table.hpp"
#include "runtime/stages/features.hpp"
#include "runtime/stages/light/footprint.hpp"
#include "runtime/stages/ray_batch.hpp"
#include "runtime/stages/sky_map.hpp"

namespace voxelume {

/// VXL_SOURCE_PARAMETERS of kernels: nothing in scenes without meshes for textures.
void bind(KernelArguments& to, const SourceMeshes& sources);

/// VXL_CUBE_STEPS_PARAMETER of kernels: nothing in scenes without resampled cubes.
struct CubeStepsArgument {
    Buffer<float> steps;
};
void bind(KernelArguments& to, const CubeStepsArgument& argument);

/// The world's background, ambient light and medium.
Environment environment_of(const World& world);

/// The kernels of shade.cl for one feature set and one scene's materials: the paper's block 3.
class ShadeStage {
  public:
    ShadeStage(const Device& device, const Features& features, const Scene& scene,
               const GridFrame& world);

    /// Finds the points, normals and packed attributes of hits 0 .. count-1, and initializes their
    /// radiance. `from_observer` is true for rays that come straight from the observer.
    void surface(const Pyramid& pyramid, RayBatch& batch, uint32_t count,
                 bool from_observer = true);

    /// Sets the emitters to which paths send rays. Needed for features with `emitters` only.
    void set_emitters(EmitterTable emitters) { emitters_ = std::move(emitters); }

    /// Sets the probability that a ray to light goes to a sky that is a map.
    void set_sky_chance(float chance) { sky_.map.record.chance = chance; }

    const Environment& environment() const { return environment_; }
    const Buffer<MaterialRecord>& materials() const { return materials_; }
    const SkyView& sky() const { return sky_; }
    /// Each object's rank by priority; empty in scenes without paths.
    const Buffer<uint32_t>& ranks() const { return ranks_; }

  private:
    Environment environment_;
    Buffer<MaterialRecord> materials_;
    Buffer<uint32_t> ranks_;
    SkyView sky_;
    bool sky_is_hidden_, has_sources_, has_cube_steps_;
    EmitterTable emitters_;
    FootprintArgument footprint_;
    Program program_;
    Kernel surface_;
};

}  // namespace voxelume
