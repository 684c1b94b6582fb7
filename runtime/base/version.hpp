// The version of the library, as files and `--version` give it.
#pragma once

namespace voxelume {

/// The version as three numbers with dots between them: "0.1.0".
const char* version();

}  // namespace voxelume
