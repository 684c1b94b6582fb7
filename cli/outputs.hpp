// Files that a command will write, looked at before it works for them.
#pragma once

#include <initializer_list>
#include <string>

namespace voxelume::cli {

/// Throws Error::usage when the name has none of the extensions, Error::output when no file can be
/// made there. `command` opens the message about the name.
void check_output(const std::string& path, std::initializer_list<const char*> extensions,
                  const char* command);

}  // namespace voxelume::cli
