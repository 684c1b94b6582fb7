// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/temporary_folder.hpp"

#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <string>
#include <string_view>
#include <system_error>

#include "runtime/base/error.hpp"
#include "runtime/base/files/private_folder.hpp"
#include "runtime/base/files/process_tag.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

constexpr std::string_view kPrefix = "voxelume.", kRandomEnd = "-XXXXXX";

/// Removes the folders of this user's processes that have ended. Others', and links, are left.
void remove_dead_folders(const fs::path& parent) {
    std::error_code error;
    for (fs::directory_iterator entry(parent, error), end; !error && entry != end;
         entry.increment(error)) {
        const std::string name = entry->path().filename();
        if (!name.starts_with(kPrefix) || name.size() < kPrefix.size() + kRandomEnd.size())
            continue;
        if (!ends_with_dead_tag(name.substr(0, name.size() - kRandomEnd.size()))) continue;
        std::error_code ignored;
        if (PrivateFolder::open(entry->path())) fs::remove_all(entry->path(), ignored);
    }
}

}  // namespace

TemporaryFolder::TemporaryFolder() {
    std::error_code error;
    const fs::path parent = fs::temp_directory_path(error);
    if (error)
        throw Error(ErrorKind::output, "{}: the temporary folder can't be used: {}; set TMPDIR",
                    SourcePlace(parent.string()), error.message());
    remove_dead_folders(parent);
    std::string name = parent / fmt::format("{}{}{}", kPrefix, process_tag(), kRandomEnd);
    if (!mkdtemp(name.data()))
        throw Error(ErrorKind::output, "{}: can't be made: {}", SourcePlace(name),
                    std::strerror(errno));
    path_ = name;
    registered_ = TemporaryFile(path_);
}

TemporaryFolder::~TemporaryFolder() {
    std::error_code ignored;
    fs::remove_all(path_, ignored);
}

}  // namespace voxelume
