// SPDX-License-Identifier: Apache-2.0
// The scene after the picture of Whitted 1980. Its light is traced in double.
#pragma once

#include <string_view>

#include "runtime/verify/bench/bench_subject.hpp"

namespace voxelume {

/// The text of scenes/whitted.json at the time when the program was built.
std::string_view whitted_text();

/// The scene in voxels of 1/`resolution` metres. All its models have the surface `surface`.
Scene whitted_scene(Surface surface, int resolution, glm::ivec2 size);

BenchSubject whitted_subject();

}  // namespace voxelume
