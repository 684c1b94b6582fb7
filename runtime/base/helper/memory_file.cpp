// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/helper/memory_file.hpp"

#include <sys/mman.h>
#include <unistd.h>

#include <cerrno>
#include <cstring>

#include "runtime/base/error.hpp"

namespace voxelume {

MemoryFile::MemoryFile(std::string_view what)
    : what_(what), descriptor_(memfd_create("voxelume", MFD_CLOEXEC)) {
    if (descriptor_ < 0) fail();
}

MemoryFile::~MemoryFile() {
    close(descriptor_);
}

void MemoryFile::append(const void* data, size_t size) const {
    const char* from = static_cast<const char*>(data);
    while (size > 0) {
        const ssize_t written = write(descriptor_, from, size);
        if (written < 0 && errno == EINTR) continue;
        if (written <= 0) fail();
        from += written;
        size -= size_t(written);
    }
}

void MemoryFile::fail() const {
    throw Error(ErrorKind::input, "no memory for {}: {}", what_, std::strerror(errno));
}

}  // namespace voxelume
