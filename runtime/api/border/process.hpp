// SPDX-License-Identifier: Apache-2.0
// What callers allow the library to do to their process, applied to its inside.
#pragma once

#include "runtime/assets/model_cache.hpp"
#include "runtime/voxelume/process.hpp"

namespace voxelume::api {

/// Applies what `configure` allowed. Every function that could start a process or set a variable of
/// the environment calls it first.
void apply_process_options();

/// The cache that a caller chose. Throws Error::usage for a wrong VOXELUME_CACHE_MB.
ModelCache model_cache(const v1::CacheOptions& options);

}  // namespace voxelume::api
