// SPDX-License-Identifier: Apache-2.0
// The version of the library, as files and `--version` give it.
#pragma once

namespace voxelume {

/// The version as three numbers with dots between them, as CMakeLists.txt has them: "0.2.0".
const char* version();

}  // namespace voxelume
