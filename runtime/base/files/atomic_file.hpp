// SPDX-License-Identifier: Apache-2.0
// A file that appears under its name whole and verified, or not at all.
#pragma once

#include <cstdint>
#include <filesystem>
#include <optional>

#include "runtime/base/error.hpp"
#include "runtime/base/files/byte_sink.hpp"
#include "runtime/base/files/temporary_files.hpp"
#include "runtime/base/files/written_blocks.hpp"

namespace voxelume {

/// Writes to `.name.<host>.<pid>.<start>.tmp` in the target's folder. commit() renames that file
/// onto the target. Those that killed processes left in the folder are removed by the next process
/// that writes there.
///
/// Until commit() returns, a file that already has the name is untouched. Without commit() the
/// destructor removes the temporary file. A link is followed: the file that it points to is
/// replaced, not the link. Every failure is an Error::output that names the target and the cause.
/// The first failure is kept, so that a library that swallows it (OpenEXR does, in a destructor)
/// still can't commit.
class AtomicFile final : public ByteSink {
  public:
    /// Creates the temporary file. Throws when the folder is missing or doesn't accept files.
    explicit AtomicFile(const std::filesystem::path& target);
    ~AtomicFile() override;
    AtomicFile(const AtomicFile&) = delete;
    AtomicFile& operator=(const AtomicFile&) = delete;

    void write(const void* data, size_t size) override;
    void seek(uint64_t position) override { position_ = position; }
    uint64_t position() const { return position_; }

    /// The current path of the bytes. A verifying reader opens it before commit().
    const std::filesystem::path& temporary() const { return temporary_; }

    /// Writes the bytes to the disk, and throws if others are read back from there.
    void read_back();

    /// Seals the bytes' stamp if they have one, writes them to the disk, reads them back from there
    /// and gives the file its name if they are what was written. If then the folder can't be
    /// synced, the file stays, and the error says that it is whole.
    void commit();

    /// Throws the first failure of this file, which is `reason` if there was none before: what a
    /// library says of a write that failed says less. commit() refuses the file from then on.
    [[noreturn]] void fail(const std::string& reason) override;

  private:
    [[noreturn]] void fail_with_errno(int code);
    [[noreturn]] void fail_as_changed();
    void create_temporary();
    void read(uint64_t position, char* data, size_t size);
    void read_and_compare(uint64_t position, char* data, size_t size);
    void put_seal();
    void sync_folder();

    std::filesystem::path target_;  ///< path as the user named it
    std::filesystem::path final_;   ///< path after links
    std::filesystem::path temporary_;
    TemporaryFile registered_;  ///< while it has no other name
    int descriptor_ = -1;
    int lock_ = -1;  ///< the same file, locked until it has its name
    uint64_t position_ = 0;
    WrittenBlocks written_;  ///< what is meant to be in the file
    std::optional<Error> failure_;
};

}  // namespace voxelume
