// SPDX-License-Identifier: Apache-2.0
// A hash of the host's code that makes models. The cache of models and worlds depends on it.
#pragma once

namespace voxelume {

/// The hashes of the sources that read, morph, summarize and voxelize meshes, place models and
/// index worlds. CMake generates this function.
const char* producer_hash();

}  // namespace voxelume
