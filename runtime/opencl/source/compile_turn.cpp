// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/compile_turn.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <thread>
#include <utility>

namespace voxelume {
namespace {

constexpr auto kBetweenLooks = std::chrono::milliseconds(20);

/// True if the folder's file of this name is the open one: the process that had the turn removes
/// its file.
bool is_named(int file, const PrivateFolder& folder, const std::string& name) {
    struct stat open_one = {}, named = {};
    return fstat(file, &open_one) == 0 &&
           fstatat(folder.descriptor(), name.c_str(), &named, AT_SYMLINK_NOFOLLOW) == 0 &&
           open_one.st_ino == named.st_ino && open_one.st_dev == named.st_dev;
}

}  // namespace

std::optional<std::string> CompileTurn::read(const DiskCache& cache, const std::string& key) {
    std::optional<std::string> bytes = cache.read(key);
    if (bytes || is_taken() || !take(cache, key)) return bytes;
    bytes = cache.read(key);
    if (bytes) release();
    return bytes;
}

/// Returns whether the entry may have been written meanwhile: true if the turn was taken, or was
/// awaited in vain.
bool CompileTurn::take(const DiskCache& cache, const std::string& key) {
    if (cache.folder().empty()) return false;
    folder_.reset();
    folder_.emplace(PrivateFolder::make(cache.folder()));
    if (!*folder_) return false;
    name_ = "." + key + ".turn";
    while (waited_ < longest_wait_) {
        const int file = openat(folder_->descriptor(), name_.c_str(),
                                O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
        if (file < 0) return false;
        const bool is_locked = flock(file, LOCK_EX | LOCK_NB) == 0;
        const bool is_busy = !is_locked && errno == EWOULDBLOCK;
        if (is_locked && is_named(file, *folder_, name_)) {
            file_ = file;
            return true;
        }
        close(file);
        if (!is_locked && !is_busy) {  // a file system without locks
            unlinkat(folder_->descriptor(), name_.c_str(), 0);
            return false;
        }
        const auto start = std::chrono::steady_clock::now();
        if (is_busy) std::this_thread::sleep_for(kBetweenLooks);
        waited_ += std::chrono::steady_clock::now() - start;
    }
    return true;
}

void CompileTurn::release() {
    if (!is_taken()) return;
    unlinkat(folder_->descriptor(), name_.c_str(), 0);  // before others can lock it
    close(std::exchange(file_, -1));
}

}  // namespace voxelume
