// SPDX-License-Identifier: Apache-2.0
// A text in files of frames that tells what they are made from, and whether they are as written.
#pragma once

#include <filesystem>
#include <optional>
#include <string>
#include <string_view>

#include "runtime/base/files/byte_sink.hpp"

namespace voxelume {

/// The state of a file by its stamp.
enum class StampState {
    missing,  ///< there is no file
    damaged,  ///< its bytes aren't those that were written, or it has no stamp
    stale,    ///< made from something else
    current   ///< made from this, and whole
};

/// The text for the header of a file: "voxelume-frame=0123...cdef check=0000000000000000". The
/// check is filled in by `seal`. `hash` has 32 hexadecimal digits and tells what the file is made
/// from.
std::string stamp_of(std::string_view hash);

/// The hash in stamps of files that aren't a frame's, and have a stamp for its check alone.
inline constexpr std::string_view kNoFrame = "00000000000000000000000000000000";

/// The hexadecimal digits of a stamp's check.
inline constexpr size_t kStampCheckDigits = 16;

/// The number of a file's first bytes among which its stamp lies.
inline constexpr size_t kStampHeader = size_t{1} << 20;

/// The position of the stamp's check in a file's first bytes; empty if there is none. Other
/// checksums in the same file leave the check out.
std::optional<size_t> stamp_check_offset(std::string_view header);

/// Fills in the check of the stamp in a file's bytes, if there is one near its start: a hash of all
/// other bytes. The bytes may be those of any format that has the text as it is; in PNG files the
/// checksum of its chunk follows. Returns whether there was one.
bool seal(std::string& bytes);

/// The bytes that seal a file, and their position.
struct StampSeal {
    uint64_t position = 0;
    std::string bytes;
};

/// What seals the stamp of a file of `size` bytes, each of which is read; empty if it has none.
/// Throws what `read` throws.
std::optional<StampSeal> seal_of(uint64_t size, const ReadBytes& read);

/// Compares a file with what it should be made from.
StampState check_stamp(const std::filesystem::path& file, std::string_view hash);

/// True if a regular file's bytes are those that were written, whatever it was made from; empty if
/// it has no stamp, or can't be read.
std::optional<bool> is_as_written(const std::filesystem::path& file);

}  // namespace voxelume
