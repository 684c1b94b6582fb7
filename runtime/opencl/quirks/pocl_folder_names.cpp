// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/quirks/pocl_folder_names.hpp"

#include <fcntl.h>
#include <fmt/format.h>
#include <sys/file.h>
#include <unistd.h>

#include <chrono>
#include <cstdlib>
#include <regex>
#include <string>
#include <string_view>
#include <system_error>

#include "runtime/base/files/private_folder.hpp"
#include "runtime/base/files/process_tag.hpp"

namespace voxelume {
namespace {

constexpr std::string_view kRandom = "-XXXXXX";  // the end of a folder's name

/// True for a name that make_pocl_folder() gives, or gave in older versions: only these are
/// removed.
bool is_of_process(const std::string& name) {
    static const std::regex pattern(R"(pocl(-[0-9]+|\..+\.[0-9]+\.[0-9]+)-[A-Za-z0-9]{6})");
    return std::regex_match(name, pattern);
}

}  // namespace

void remove_stale_pocl_folders(const std::filesystem::path& parent) {
    std::error_code error;
    const auto now = std::filesystem::file_time_type::clock::now();
    for (const std::filesystem::directory_entry& entry :
         std::filesystem::directory_iterator(parent, error)) {
        const std::string name = entry.path().filename();
        if (!is_of_process(name)) continue;
        const bool is_new = now - entry.last_write_time(error) < std::chrono::minutes(1);
        const std::string_view tag(name.data(), name.size() - kRandom.size());
        if (error || (is_new && !ends_with_dead_tag(tag))) continue;
        const PrivateFolder folder = PrivateFolder::open(entry.path());
        if (!folder) continue;
        const int lock = openat(folder.descriptor(), kPoclFolderLock,
                                O_RDWR | O_CREAT | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC, 0600);
        if (lock < 0) continue;
        if (flock(lock, LOCK_EX | LOCK_NB) == 0) std::filesystem::remove_all(entry.path(), error);
        close(lock);
    }
}

std::filesystem::path make_pocl_folder(const std::filesystem::path& parent) {
    constexpr uintmax_t kRoom = 32u << 20;
    std::error_code error;
    if (!make_safe_parent(parent)) return {};
    if (std::filesystem::space(parent, error).available < kRoom || error) return {};
    std::string name = (parent / fmt::format("pocl.{}{}", process_tag(), kRandom)).string();
    return mkdtemp(name.data()) ? std::filesystem::path(name) : std::filesystem::path();
}

}  // namespace voxelume
