// scene -> S: every object voxelized, placed, and indexed for rays. The paper's block 1.
#pragma once

#include "runtime/grid.hpp"
#include "runtime/instances.hpp"
#include "runtime/opencl/device.hpp"
#include "runtime/scene.hpp"

namespace voxelume {

/// What forming the world took, for people and tests.
struct WorldReport {
    double load_seconds = 0;      ///< reading model files
    double voxelize_seconds = 0;  ///< waiting for the device included
    double place_seconds = 0;
    double index_seconds = 0;
    uint64_t triangles = 0;
    InstanceReport instances;
};

/// Forms S from the scene's objects. Models that no object shows inside the world are not read.
///
/// The plan is made and checked first (runtime/plan.hpp), so a world that doesn't fit costs
/// nothing. Throws Error::input for a damaged model, Error::scene for a placement or group name
/// that doesn't fit, Error::limit for a world that the device has no memory for.
Pyramid form_world(const Device& device, const Scene& scene, WorldReport& report);

}  // namespace voxelume
