// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/input_file.hpp"

#include <fcntl.h>
#include <sys/stat.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

namespace voxelume {

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
    if (fstat(descriptor_, &status) != 0 || !S_ISREG(status.st_mode)) {
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

std::vector<uint8_t> InputFile::bytes() const {
    std::vector<uint8_t> bytes(size_);
    read(0, bytes.data(), bytes.size());
    return bytes;
}

void InputFile::refuse(const std::string& reason) const {
    throw Error(ErrorKind::input, "{}: {}", SourcePlace(path_.string()), reason);
}

}  // namespace voxelume
