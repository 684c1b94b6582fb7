// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/input_file.hpp"

#include <fcntl.h>
#include <linux/magic.h>
#include <sys/stat.h>
#include <sys/vfs.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace voxelume {

namespace {

/// True for a file behind which a function of the kernel stands, such as /proc/kmsg. It is a
/// regular one by its mode, but its size is wrong, and reading may wait for data.
bool is_of_system(int descriptor) {
    struct statfs system {};
    if (fstatfs(descriptor, &system) != 0) return false;
    return system.f_type == PROC_SUPER_MAGIC || system.f_type == SYSFS_MAGIC ||
           system.f_type == DEBUGFS_MAGIC || system.f_type == TRACEFS_MAGIC;
}

}  // namespace

InputFile::InputFile(const std::filesystem::path& path) : path_(path) {
    // Without O_NONBLOCK, opening a pipe would wait for its writer.
    descriptor_ = open(path.c_str(), O_RDONLY | O_CLOEXEC | O_NONBLOCK);
    if (descriptor_ < 0) refuse(errno == ENOENT ? "no such file" : std::strerror(errno));
    take_size();
}

InputFile::InputFile(const std::filesystem::path& path, int descriptor)
    : path_(path), descriptor_(descriptor) {
    take_size();
}

void InputFile::take_size() {
    struct stat status {};
    if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode) || is_of_system(descriptor_)) {
        close(descriptor_);
        refuse("isn't a plain file");
    }
    size_ = static_cast<uint64_t>(status.st_size);
}

InputFile::~InputFile() {
    close(descriptor_);
}

void InputFile::read(uint64_t position, void* data, size_t size) const {
    char* bytes = static_cast<char*>(data);
    while (size > 0) {
        const ssize_t got = pread(descriptor_, bytes, size, static_cast<off_t>(position));
        if (got < 0 && errno == EINTR) continue;
        if (got < 0) refuse(std::strerror(errno));
        if (got == 0) refuse("the file ends too early; it is truncated");
        bytes += got;
        size -= static_cast<size_t>(got);
        position += static_cast<uint64_t>(got);
    }
}

std::string InputFile::read_all(uint64_t max_bytes) const {
    if (size_ > max_bytes)
        throw Error(ErrorKind::limit, "{}: {} bytes, and such a file has at most {}",
                    SourcePlace(path_.string()), size_, max_bytes);
    std::string bytes(size_, '\0');
    read(0, bytes.data(), bytes.size());
    return bytes;
}

std::vector<uint8_t> InputFile::bytes() const {
    std::vector<uint8_t> bytes(size_);
    read(0, bytes.data(), bytes.size());
    return bytes;
}

void InputFile::refuse(const std::string& reason) const {
    throw Error(ErrorKind::input, "{}: {}", SourcePlace(path_.string()), reason);
}

}  // namespace voxelume
