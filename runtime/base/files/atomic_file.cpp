// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/atomic_file.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <sys/stat.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <cstring>
#include <mutex>
#include <set>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

#include "runtime/base/files/process_tag.hpp"
#include "runtime/base/files/stamp.hpp"

namespace voxelume {

namespace fs = std::filesystem;

namespace {

constexpr const char* kEnding = ".tmp";
constexpr size_t kReadAtOnce = 16 * WrittenBlocks::kBlock;  // bytes

fs::path folder_of(const fs::path& file) {
    return file.has_parent_path() ? file.parent_path() : fs::path(".");
}

/// The name that commit() renames the file onto. Links are followed, even one that leads nowhere
/// yet.
fs::path follow_links(const fs::path& target) {
    std::error_code ignored;
    fs::path file = target;
    for (int depth = 0; depth < 40 && fs::is_symlink(file, ignored); ++depth)
        file = folder_of(file) / fs::read_symlink(file, ignored);
    return file;
}

/// True if a writer holds the file, as far as the file system knows of locks.
bool is_locked(const fs::path& path) {
    const int file = open(path.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return true;
    const bool is_held = flock(file, LOCK_EX | LOCK_NB) != 0 && errno == EWOULDBLOCK;
    close(file);
    return is_held;
}

/// `.name.TAG.tmp` or `.name.TAG-2.tmp` without the dot, the ending and the number.
std::string_view without_number(std::string_view name) {
    name.remove_suffix(std::string_view(kEnding).size());
    const size_t digits = name.find_last_not_of("0123456789");
    if (digits != std::string_view::npos && name[digits] == '-') name = name.substr(0, digits);
    return name;
}

/// Removes the temporary files that killed processes left in a folder. Looks through each folder
/// once, as it may hold a million frames.
void remove_leftovers(const fs::path& folder) {
    static std::mutex mutex;
    static std::set<fs::path> seen;
    std::error_code error;
    const fs::path absolute = fs::absolute(folder, error);
    const std::lock_guard guard(mutex);
    if (error || !seen.insert(absolute).second) return;
    fs::directory_iterator file(absolute, error);
    for (; !error && file != fs::directory_iterator(); file.increment(error)) {
        const std::string name = file->path().filename().string();
        if (!name.starts_with('.') || !name.ends_with(kEnding)) continue;
        if (ends_with_dead_tag(without_number(name)) && file->is_regular_file(error) &&
            !is_locked(file->path()))
            unlink(file->path().c_str());
    }
}

std::string reason_for(int code, const fs::path& folder) {
    switch (code) {
        case ENOSPC:
            return "the disk is full; free some space or write to another folder";
        case EDQUOT:
            return "your quota of the disk is used up; free some space or write to another folder";
        case EFBIG:
            return "the file grows beyond the size allowed here; see `ulimit -f`";
        case EROFS:
            return "the file system is read-only; write to another folder";
        case EACCES:
        case EPERM:
            return fmt::format("the folder {} doesn't allow it; check its permissions",
                               folder.string());
        case ENOENT:
            if (std::error_code ignored; fs::is_directory(folder, ignored))
                return fmt::format("the folder {} takes no new files; write to another folder",
                                   folder.string());
            return fmt::format("there is no folder {}; create it first", folder.string());
        case ENOTDIR:
            return fmt::format("{} isn't a folder", folder.string());
        case ENAMETOOLONG:
            return "the name is too long";
        default:
            return std::strerror(code);
    }
}

}  // namespace

AtomicFile::AtomicFile(const fs::path& target) : target_(target), final_(follow_links(target)) {
    std::error_code ignored;
    const fs::file_status status = fs::status(final_, ignored);
    if (!final_.has_filename()) fail("a file name is missing");
    if (fs::is_directory(status)) fail("a folder has this name");
    // Renaming onto /dev/null or a pipe would replace it by a plain file.
    if (fs::exists(status) && !fs::is_regular_file(status)) fail("it isn't a plain file");
    create_temporary();
}

AtomicFile::~AtomicFile() {
    if (descriptor_ >= 0) close(descriptor_);
    if (lock_ >= 0) close(lock_);
    if (!temporary_.empty()) unlink(temporary_.c_str());
}

void AtomicFile::create_temporary() {
    const fs::path folder = folder_of(final_);
    remove_leftovers(folder);
    // The longer temporary name has to stay within the file system's limit on names, too.
    const std::string stem =
        fmt::format(".{}.{}", final_.filename().string().substr(0, 130), process_tag());
    // The first name is taken if this process already writes a file for this target.
    for (int attempt = 1; attempt <= 1000; ++attempt) {
        const std::string ending = attempt == 1 ? kEnding : fmt::format("-{}{}", attempt, kEnding);
        const fs::path candidate = folder / (stem + ending);
        descriptor_ = open(candidate.c_str(), O_RDWR | O_CREAT | O_EXCL | O_CLOEXEC, 0666);
        if (descriptor_ >= 0) {
            temporary_ = candidate;
            registered_ = TemporaryFile(temporary_);
            // The lock tells processes in other containers, which can't see this one, that it is
            // alive.
            lock_ = fcntl(descriptor_, F_DUPFD_CLOEXEC, 0);
            flock(lock_, LOCK_EX | LOCK_NB);
            return;
        }
        if (errno != EEXIST) fail_with_errno(errno);
    }
    fail_with_errno(EEXIST);
}

void AtomicFile::write(const void* data, size_t size) {
    const char* bytes = static_cast<const char*>(data);
    const auto from_file = [this](uint64_t at, char* to, size_t count) { read(at, to, count); };
    if (!written_.put(position_, bytes, size, from_file)) fail_as_changed();
    while (size > 0) {
        const ssize_t written = pwrite(descriptor_, bytes, size, static_cast<off_t>(position_));
        if (written < 0 && errno == EINTR) continue;
        if (written < 0) fail_with_errno(errno);
        if (written == 0) fail_with_errno(ENOSPC);
        bytes += written;
        size -= static_cast<size_t>(written);
        position_ += static_cast<uint64_t>(written);
    }
}

void AtomicFile::read(uint64_t position, char* data, size_t size) {
    while (size > 0) {
        const ssize_t got = pread(descriptor_, data, size, static_cast<off_t>(position));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) fail_with_errno(errno);
        if (got == 0) fail_as_changed();
        data += got;
        size -= static_cast<size_t>(got);
        position += static_cast<uint64_t>(got);
    }
}

/// `position` and `size` are as WrittenBlocks::match asks for.
void AtomicFile::read_and_compare(uint64_t position, char* data, size_t size) {
    read(position, data, size);
    if (!written_.match(position, data, size)) fail_as_changed();
}

void AtomicFile::put_seal() {
    const std::optional<StampSeal> found =
        seal_of(written_.size(), [this](uint64_t position, char* data, size_t size) {
            read_and_compare(position, data, size);
        });
    if (!found) return;
    position_ = found->position;
    write(found->bytes.data(), found->bytes.size());
}

/// The system's copies are dropped first, so that the disk's bytes are read where the file system
/// allows that.
void AtomicFile::read_back() {
    if (fsync(descriptor_) != 0) fail_with_errno(errno);
    posix_fadvise(descriptor_, 0, 0, POSIX_FADV_DONTNEED);
    struct stat status {};
    if (fstat(descriptor_, &status) != 0) fail_with_errno(errno);
    const uint64_t size = written_.size();
    if (static_cast<uint64_t>(status.st_size) != size) fail_as_changed();
    std::vector<char> bytes(std::min<uint64_t>(size, kReadAtOnce));
    for (uint64_t at = 0; at < size; at += bytes.size())
        read_and_compare(at, bytes.data(), std::min<uint64_t>(bytes.size(), size - at));
}

void AtomicFile::commit() {
    if (failure_) throw *failure_;
    put_seal();
    read_back();
    const int closing = descriptor_;
    descriptor_ = -1;
    if (close(closing) != 0) fail_with_errno(errno);
    if (rename(temporary_.c_str(), final_.c_str()) != 0) fail_with_errno(errno);
    temporary_.clear();
    registered_ = {};
    close(std::exchange(lock_, -1));
    sync_folder();
}

void AtomicFile::sync_folder() {
    const int folder = open(folder_of(final_).c_str(), O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    // A folder that may be written but not listed can't be opened. Its file is complete anyway.
    if (folder < 0) return;
    const int code = fsync(folder) == 0 ? 0 : errno;
    close(folder);
    if (code == 0 || code == EINVAL || code == ENOTSUP) return;
    throw Error(ErrorKind::output,
                "{}: is written and whole, but may be lost if the power fails now, as its folder "
                "can't be synced: {}",
                SourcePlace(target_.string()), reason_for(code, folder_of(final_)));
}

void AtomicFile::fail(const std::string& reason) {
    if (!failure_)
        failure_ = Error(ErrorKind::output, "{}: can't be written: {}",
                         SourcePlace(target_.string()), reason);
    throw *failure_;
}

void AtomicFile::fail_as_changed() {
    fail(
        "other bytes are read back than were written; the disk or the memory is faulty: write to "
        "another disk");
}

void AtomicFile::fail_with_errno(int code) {
    fail(reason_for(code, folder_of(final_)));
}

}  // namespace voxelume
