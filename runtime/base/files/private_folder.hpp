// SPDX-License-Identifier: Apache-2.0
// Folders whose files are trusted, because no other user can put files there.
#pragma once

#include <filesystem>
#include <string>

namespace voxelume {

/// An open folder that belongs to this user and that nobody else may write to. Its files are
/// reached through its descriptor, so that nobody can put another folder in its place meanwhile.
class PrivateFolder {
  public:
    /// Opens the folder. A link in its place isn't followed; one in the place of the folder above
    /// it is, if this user or root made it, and so are links further up.
    static PrivateFolder open(const std::filesystem::path& path);
    /// Opens a folder to read from, which may be root's as well.
    static PrivateFolder open_base(const std::filesystem::path& path);
    /// Makes the folder, and those above it that are missing, for this user alone (0700), then
    /// opens it.
    static PrivateFolder make(const std::filesystem::path& path);

    PrivateFolder(PrivateFolder&& other) noexcept;
    PrivateFolder& operator=(PrivateFolder&&) = delete;
    ~PrivateFolder();

    explicit operator bool() const { return descriptor_ >= 0; }
    int descriptor() const { return descriptor_; }
    /// Why the folder isn't open, for a sentence: "Permission denied"; else empty.
    const std::string& refusal() const { return refusal_; }
    bool is_missing() const { return is_missing_; }

  private:
    PrivateFolder() = default;
    static PrivateFolder open_trusted(const std::filesystem::path& path, bool may_be_roots);

    int descriptor_ = -1;
    std::string refusal_;
    bool is_missing_ = false;
};

/// True for a link that this user or root made.
bool is_link_to_follow(const std::filesystem::path& path);

/// Makes the folder for this user alone if it is missing, with those above it. Returns whether
/// others can't rename what this user puts there: it is this user's or root's, and others can't
/// write to it or it is sticky, as /tmp is, and no other user's link leads to it.
bool make_safe_parent(const std::filesystem::path& path);

}  // namespace voxelume
