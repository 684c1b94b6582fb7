// SPDX-License-Identifier: Apache-2.0
// Computed results on disk, under a hash of everything that they were computed from.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

/// The user's folder for results that can be computed again: the last one of VOXELUME_CACHE_DIR,
/// else XDG_CACHE_HOME/voxelume, else ~/.cache/voxelume. It is empty if there is none, and if
/// VOXELUME_CACHE_DIR ends with nothing.
std::filesystem::path cache_folder();

/// The folder of compiled kernels below `cache_folder()`; empty without a cache.
std::filesystem::path programs_folder();

/// The folders before the last one of VOXELUME_CACHE_DIR, between colons: what is in them is read,
/// and nothing is written there. With `name`, the folders of that name below them.
std::vector<std::filesystem::path> cache_bases(const std::string& name = {});

/// The reason why a base, or a folder in it, isn't read, in words for people; empty if all is read.
std::string refusal_of_base(const std::filesystem::path& base);

/// A 128-bit hash (XXH3) of all `parts` and their lengths, as 32 hexadecimal digits.
std::string cache_key(std::span<const std::string_view> parts);

class PrivateFolder;

/// A folder of files named by `cache_key`. Any number of processes may share it.
///
/// An entry is a header with a checksum, then the bytes. It appears by a rename, so it is whole or
/// absent. An entry that is damaged later fails its checksum, is removed and counts as absent. When
/// the folder grows past `max_bytes`, the entries used longest ago are removed first. Nothing here
/// throws: a folder that can't be written keeps nothing.
///
/// What the folder doesn't have is looked for in folders that are only read, its bases.
///
/// The checksum tells damage, not malice, so the folder is a PrivateFolder: nothing is read from
/// one that others may write to. A base may be root's.
class DiskCache {
  public:
    DiskCache(std::filesystem::path folder, uint64_t max_bytes,
              std::vector<std::filesystem::path> bases = {})
        : folder_(std::move(folder)), bases_(std::move(bases)), max_bytes_(max_bytes) {}

    std::optional<std::string> read(const std::string& key) const noexcept;
    void write(const std::string& key, std::string_view bytes) const noexcept;

    /// Why nothing can be written, in the words of the system: "Permission denied", or that its
    /// disk has no room for a scene's kernels. Empty if something can be, and for a cache that
    /// keeps nothing. Asking leaves no file behind.
    std::string refusal() const;
    const std::filesystem::path& folder() const { return folder_; }

  private:
    void trim(const PrivateFolder& folder) const;

    std::filesystem::path folder_;  ///< empty if nothing is kept
    std::vector<std::filesystem::path> bases_;
    uint64_t max_bytes_;
};

}  // namespace voxelume
