// SPDX-License-Identifier: Apache-2.0
// A folder for files that no other user can see and that don't outlive the process for long.
#pragma once

#include <filesystem>

#include "runtime/base/files/temporary_files.hpp"

namespace voxelume {

/// A new folder of this user alone, of a random name, in the system's temporary folder. It is
/// removed with all that is in it: by the destructor, by `delete_temporary_files`, and where the
/// process was killed, by the next one that makes such a folder.
class TemporaryFolder {
  public:
    /// Throws Error::output with the folder and the cause if it can't be made.
    TemporaryFolder();
    ~TemporaryFolder();
    TemporaryFolder(const TemporaryFolder&) = delete;
    TemporaryFolder& operator=(const TemporaryFolder&) = delete;

    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
    TemporaryFile registered_;
};

}  // namespace voxelume
