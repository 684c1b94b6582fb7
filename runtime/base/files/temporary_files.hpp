// SPDX-License-Identifier: Apache-2.0
// The files that this process has begun to write, for a program that has to end at once.
#pragma once

#include <filesystem>

namespace voxelume {

/// A file, or a folder with all that is in it, that is deleted by `delete_temporary_files`, as long
/// as this lives.
class TemporaryFile {
  public:
    TemporaryFile() = default;
    explicit TemporaryFile(const std::filesystem::path& file);
    ~TemporaryFile();
    TemporaryFile(TemporaryFile&& other) noexcept;
    TemporaryFile& operator=(TemporaryFile&& other) noexcept;

  private:
    std::filesystem::path file_;
};

/// Deletes all registered files. Any thread may call it.
void delete_temporary_files();

}  // namespace voxelume
