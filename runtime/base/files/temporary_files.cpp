// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/temporary_files.hpp"

#include <mutex>
#include <set>
#include <system_error>
#include <utility>

namespace voxelume {
namespace {

struct FileRegister {
    std::mutex mutex;
    std::set<std::filesystem::path> files;
};

/// Never destroyed: threads may write when the process ends.
FileRegister& registered_files() {
    static auto* const files = new FileRegister;
    return *files;
}

}  // namespace

TemporaryFile::TemporaryFile(const std::filesystem::path& file)
    : file_(std::filesystem::absolute(file)) {
    FileRegister& all = registered_files();
    const std::lock_guard lock(all.mutex);
    all.files.insert(file_);
}

TemporaryFile::~TemporaryFile() {
    if (file_.empty()) return;
    FileRegister& all = registered_files();
    const std::lock_guard lock(all.mutex);
    all.files.erase(file_);
}

TemporaryFile::TemporaryFile(TemporaryFile&& other) noexcept
    : file_(std::exchange(other.file_, {})) {}

TemporaryFile& TemporaryFile::operator=(TemporaryFile&& other) noexcept {
    std::swap(file_, other.file_);
    return *this;
}

void delete_temporary_files() {
    FileRegister& all = registered_files();
    const std::lock_guard lock(all.mutex);
    std::error_code ignored;
    for (const std::filesystem::path& file : all.files) std::filesystem::remove_all(file, ignored);
}

}  // namespace voxelume
