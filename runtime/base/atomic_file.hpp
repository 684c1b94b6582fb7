// A file that appears under its name whole and checked, or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "runtime/base/error.hpp"

namespace voxelume {

/// Writes to `.name.<host>.<pid>.tmp` in the target's folder; commit() renames that onto the
/// target.
///
/// Until commit() returns, whatever was under the name before is untouched; without commit() the
/// destructor removes the temporary file. A link is followed: the file it points to is replaced,
/// not the link. Every failure is an Error::output that names the target and the cause. The first
/// one is kept: a library that swallows it (OpenEXR does, in a destructor) still can't commit.
class AtomicFile {
  public:
    /// Creates the temporary file. Throws when the folder is missing or doesn't accept files.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile();
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* data, size_t size);
    void seek(uint64_t position) { position_ = position; }
    uint64_t position() const { return position_; }

    /// Where the bytes are now: what a verifying reader opens before commit().
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Puts the bytes on the disk and the file under its name.
    void commit();

    /// Makes `reason` the failure of this file, so that commit() refuses it, and throws it.
    [[noreturn]] void fail(const std::string& reason);

  private:
    [[noreturn]] void fail_with_errno(int code);
    void create_temporary();
    void sync_folder();

    std::filesystem::path target_;  ///< as the user named it
    std::filesystem::path final_;   ///< links followed
    std::filesystem::path temporary_;
    int descriptor_ = -1;
    uint64_t position_ = 0;
    std::optional<Error> failure_;
};

}  // namespace voxelume
