// SPDX-License-Identifier: Apache-2.0
// What callers allow the library to do to their process, applied to its inside.
#pragma once

#include "runtime/assets/model_cache.hpp"
#include "runtime/voxelume/process.hpp"

namespace voxelume::api {

/// Has the inside of the library do what `configure` allowed, and nothing without it. Called by
/// every function that might do it otherwise.
void apply_process_options();

/// The cache that a caller chose. Throws Error::usage for a wrong VOXELUME_CACHE_MB.
ModelCache model_cache(const v1::CacheOptions& options);

}  // namespace voxelume::api
