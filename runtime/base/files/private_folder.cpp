// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/private_folder.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>
#include <utility>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

constexpr mode_t kOthersWrite = S_IWGRP | S_IWOTH;

void make_folders(const fs::path& path) {
    fs::path folder;
    for (const fs::path& part : path) {
        folder /= part;
        mkdir(folder.c_str(), 0700);  // a failure shows when it is opened
    }
}

/// The status of a link, if the path is one.
bool find_link(const fs::path& path, struct stat& status) {
    // If the name ended in a slash, the link's target would be found.
    const fs::path name = path.has_filename() ? path : path.parent_path();
    return lstat(name.c_str(), &status) == 0 && S_ISLNK(status.st_mode);
}

bool is_trusted_owner(const struct stat& status) {
    return status.st_uid == geteuid() || status.st_uid == 0;
}

bool is_foreign_link(const fs::path& path) {
    struct stat status {};
    return find_link(path, status) && !is_trusted_owner(status);
}

}  // namespace

bool is_link_to_follow(const fs::path& path) {
    struct stat status {};
    return find_link(path, status) && is_trusted_owner(status);
}

PrivateFolder PrivateFolder::open(const fs::path& path) {
    return open_trusted(path, false);
}

PrivateFolder PrivateFolder::open_base(const fs::path& path) {
    return open_trusted(path, true);
}

PrivateFolder PrivateFolder::open_trusted(const fs::path& path, bool may_be_roots) {
    PrivateFolder folder;
    // If the name ended in a slash, a link's target would be opened.
    const fs::path name = path.has_filename() ? path : path.parent_path();
    if (is_foreign_link(name.parent_path())) {
        folder.refusal_ = "another user's link leads to it";
        return folder;
    }
    folder.descriptor_ =
        ::open(name.c_str(), O_RDONLY | O_DIRECTORY | O_NOFOLLOW | O_CLOEXEC | O_NONBLOCK);
    if (folder.descriptor_ < 0) {
        folder.is_missing_ = errno == ENOENT;
        struct stat status {};
        const bool is_link = find_link(name, status);
        folder.refusal_ = is_link ? "a link in the place of a folder isn't followed"
                                  : std::strerror(errno == ELOOP ? ENOTDIR : errno);
        return folder;
    }
    struct stat status {};
    if (fstat(folder.descriptor_, &status) != 0)
        folder.refusal_ = std::strerror(errno);
    else if (status.st_uid != geteuid() && !(may_be_roots && status.st_uid == 0))
        folder.refusal_ = "it belongs to another user";
    else if (status.st_mode & kOthersWrite)
        folder.refusal_ = "other users may write to it; `chmod go-w` forbids them";
    if (!folder.refusal_.empty()) close(std::exchange(folder.descriptor_, -1));
    return folder;
}

PrivateFolder PrivateFolder::make(const fs::path& path) {
    PrivateFolder folder = open(path);
    if (!folder.is_missing()) return folder;
    make_folders(path);
    return open(path);
}

PrivateFolder::PrivateFolder(PrivateFolder&& other) noexcept
    : descriptor_(std::exchange(other.descriptor_, -1)),
      refusal_(std::move(other.refusal_)),
      is_missing_(other.is_missing_) {}

PrivateFolder::~PrivateFolder() {
    if (descriptor_ >= 0) close(descriptor_);
}

bool make_safe_parent(const fs::path& path) {
    if (is_foreign_link(path)) return false;
    make_folders(path);
    struct stat status {};
    if (stat(path.c_str(), &status) != 0 || !S_ISDIR(status.st_mode)) return false;
    if (status.st_uid != geteuid() && status.st_uid != 0) return false;
    return !(status.st_mode & kOthersWrite) || (status.st_mode & S_ISVTX);
}

}  // namespace voxelume
