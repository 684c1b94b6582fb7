// The version of the library, as files and `--version` name it.
#pragma once

namespace voxelume {

/// Three numbers with dots between them, as CMakeLists.txt has them: "0.2.0".
const char* version();

}  // namespace voxelume
