// The version of the library, as files and `--version` name it.
#pragma once

namespace voxelume {

/// Three numbers with dots between them: "0.1.0".
const char* version();

}  // namespace voxelume
