// SPDX-License-Identifier: Apache-2.0
// The text that `voxelume --version` prints about the build.
#pragma once

namespace voxelume::cli {

/// Lines with the commit, the compiler, the kind of build and the versions of libraries. CMake
/// generates this function.
const char* build_facts();

}  // namespace voxelume::cli
