// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/files/disk_cache.hpp"

#include <dirent.h>
#include <fcntl.h>
#include <fmt/format.h>
#include <sys/stat.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <cstdlib>
#include <cstring>
#include <ctime>
#include <memory>
#include <new>
#include <system_error>

#include "runtime/base/files/private_folder.hpp"
#include "runtime/base/files/process_tag.hpp"

namespace voxelume {
namespace {

namespace fs = std::filesystem;

/// The bytes before those of an entry. The version in `magic` changes with this layout.
struct Header {
    char magic[8];
    char key[32];
    uint64_t size;      ///< bytes that follow
    uint64_t checksum;  ///< XXH3 of the bytes that follow
};
static_assert(sizeof(Header) == 56);

Header header_of(const std::string& key, std::string_view bytes) {
    Header header = {{'V', 'X', 'L', 'C', 'A', 'C', 'H', '1'}, {}, bytes.size(), 0};
    std::copy_n(key.data(), std::min(key.size(), sizeof header.key), header.key);
    header.checksum = XXH3_64bits(bytes.data(), bytes.size());
    return header;
}

/// The whole of a plain file in a folder; empty if there is none.
std::string whole_file(const PrivateFolder& folder, const std::string& name) {
    const int file =
        openat(folder.descriptor(), name.c_str(), O_RDONLY | O_NOFOLLOW | O_NONBLOCK | O_CLOEXEC);
    if (file < 0) return {};
    std::string text;
    struct stat status {};
    if (fstat(file, &status) == 0 && S_ISREG(status.st_mode)) text.resize(size_t(status.st_size));
    size_t size = 0;
    for (ssize_t got = 1; size < text.size() && got > 0; size += size_t(std::max<ssize_t>(got, 0)))
        got = pread(file, text.data() + size, text.size() - size, off_t(size));
    close(file);
    text.resize(size);
    return text;
}

/// The entry that a folder has under a key.
struct Found {
    std::optional<std::string> bytes;
    bool is_damaged = false;
};

Found read_entry(const PrivateFolder& folder, const std::string& key) {
    std::string entry = whole_file(folder, key);
    if (entry.empty()) return {};
    Header found = {};
    std::memcpy(&found, entry.data(), std::min(entry.size(), sizeof found));
    const std::string_view bytes =
        std::string_view(entry).substr(std::min(entry.size(), sizeof found));
    const Header expected = header_of(key, bytes);
    if (std::memcmp(&found, &expected, sizeof found) != 0) return {{}, true};
    entry.erase(0, sizeof found);
    return {std::move(entry), false};
}

bool write_all(int file, std::string_view bytes) {
    while (!bytes.empty()) {
        const ssize_t written = ::write(file, bytes.data(), bytes.size());
        if (written <= 0) return false;
        bytes.remove_prefix(size_t(written));
    }
    return true;
}

bool is_temporary(const std::string& name) {
    return name.starts_with('.');
}

/// The reason why no file can be made in a folder; empty if one can. Leaves nothing behind.
/// Permissions alone don't tell: root has all of them for /proc, where nobody can make a file.
std::string refusal_of_new_entries(const fs::path& folder) {
    constexpr uintmax_t kRoom = 1u << 18;  // bytes that the kernels of no scene fit in
    std::error_code error;
    const fs::space_info space = fs::space(folder, error);
    const bool has_size = !error && space.capacity > 0;  // some file systems don't tell
    if (has_size && space.available < kRoom)
        return fmt::format("its disk has only {:.1f} MB left", double(space.available) / 1e6);
    const int file = open(folder.c_str(), O_TMPFILE | O_WRONLY | O_CLOEXEC, 0600);
    if (file >= 0) {
        close(file);
        return {};
    }
    if (errno != EOPNOTSUPP && errno != EISDIR && errno != EINVAL) return std::strerror(errno);
    std::string name = folder / ".voxelume-XXXXXX";  // the file system has no nameless files
    if (!mkdtemp(name.data())) return std::strerror(errno);
    rmdir(name.c_str());
    return {};
}

fs::path environment_path(const char* name) {
    const char* value = std::getenv(name);
    return value ? fs::path(value) : fs::path();
}

}  // namespace

fs::path cache_folder() {
    if (const char* folders = std::getenv("VOXELUME_CACHE_DIR")) {
        const std::string_view text = folders;
        return text.substr(text.find_last_of(':') + 1);
    }
    const fs::path shared = environment_path("XDG_CACHE_HOME");
    if (shared.is_absolute()) return shared / "voxelume";
    const fs::path home = environment_path("HOME");
    return home.is_absolute() ? home / ".cache" / "voxelume" : fs::path();
}

fs::path programs_folder() {
    const fs::path folder = cache_folder();
    return folder.empty() ? folder : folder / "programs";
}

std::vector<fs::path> cache_bases(const std::string& name) {
    std::vector<fs::path> bases;
    const char* folders = std::getenv("VOXELUME_CACHE_DIR");
    std::string_view text = folders ? folders : "";
    for (size_t end = text.find(':'); end != text.npos; end = text.find(':')) {
        const fs::path base = text.substr(0, end);
        if (end > 0) bases.push_back(name.empty() ? base : base / name);
        text.remove_prefix(end + 1);
    }
    return bases;
}

std::string refusal_of_base(const fs::path& base) {
    std::error_code error;
    const fs::path real = is_link_to_follow(base) ? fs::canonical(base, error) : base;
    if (const PrivateFolder folder = PrivateFolder::open_base(real); !folder)
        return folder.is_missing() ? "there is no such folder" : folder.refusal();
    for (const auto& entry : fs::directory_iterator(real, error)) {
        if (!entry.is_directory(error)) continue;
        if (const PrivateFolder folder = PrivateFolder::open_base(entry.path()); !folder)
            return fmt::format("{}: {}", entry.path().filename().string(), folder.refusal());
    }
    return error ? error.message() : "";
}

std::string cache_key(std::span<const std::string_view> parts) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         &XXH3_freeState);
    if (!state) throw std::bad_alloc();
    XXH3_128bits_reset(state.get());
    for (const std::string_view part : parts) {
        const std::string size = fmt::format("{}:", part.size());
        XXH3_128bits_update(state.get(), size.data(), size.size());
        XXH3_128bits_update(state.get(), part.data(), part.size());
    }
    const XXH128_hash_t hash = XXH3_128bits_digest(state.get());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::optional<std::string> DiskCache::read(const std::string& key) const noexcept try {
    if (!folder_.empty()) {
        const PrivateFolder folder = PrivateFolder::open(folder_);
        if (folder) {
            Found found = read_entry(folder, key);
            if (found.is_damaged) unlinkat(folder.descriptor(), key.c_str(), 0);
            if (found.bytes)
                utimensat(folder.descriptor(), key.c_str(), nullptr, AT_SYMLINK_NOFOLLOW);
            if (found.bytes) return std::move(found.bytes);
        }
    }
    for (const fs::path& base : bases_) {
        const PrivateFolder folder = PrivateFolder::open_base(base);
        if (!folder) continue;
        if (Found found = read_entry(folder, key); found.bytes) return std::move(found.bytes);
    }
    return std::nullopt;
} catch (const std::exception&) {
    return std::nullopt;
}

void DiskCache::write(const std::string& key, std::string_view bytes) const noexcept try {
    if (folder_.empty()) return;
    static std::atomic<int> number = 0;
    const PrivateFolder folder = PrivateFolder::make(folder_);
    if (!folder) return;
    const std::string temporary = fmt::format(".{}.{}.{}", key, number++, process_tag());
    const int file = openat(folder.descriptor(), temporary.c_str(),
                            O_WRONLY | O_CREAT | O_EXCL | O_CLOEXEC, 0600);
    if (file < 0) return;
    const Header header = header_of(key, bytes);
    bool is_whole = write_all(file, {reinterpret_cast<const char*>(&header), sizeof header}) &&
                    write_all(file, bytes);
    is_whole = close(file) == 0 && is_whole;
    if (!is_whole ||
        renameat(folder.descriptor(), temporary.c_str(), folder.descriptor(), key.c_str()) != 0)
        unlinkat(folder.descriptor(), temporary.c_str(), 0);
    trim(folder);
} catch (const std::exception&) {
    return;  // the next run computes it again
}

std::string DiskCache::refusal() const {
    std::error_code error;
    fs::path existing = fs::absolute(folder_, error);
    if (folder_.empty() || error) return {};
    const PrivateFolder folder = PrivateFolder::open(existing);
    if (!folder && !folder.is_missing()) return folder.refusal();
    // A folder that doesn't exist is made in the nearest one above it that does.
    while (!fs::exists(existing, error) && !error && existing.has_relative_path())
        existing = existing.parent_path();
    if (error) return error.message();
    if (!fs::is_directory(existing, error)) return std::strerror(ENOTDIR);
    return refusal_of_new_entries(existing);
}

void DiskCache::trim(const PrivateFolder& folder) const {
    struct Entry {
        std::string name;
        int64_t used;
        uint64_t bytes;
    };
    std::vector<Entry> entries;
    uint64_t total = 0;
    const int descriptor = openat(folder.descriptor(), ".", O_RDONLY | O_DIRECTORY | O_CLOEXEC);
    DIR* const list = descriptor < 0 ? nullptr : fdopendir(descriptor);
    if (!list) return;
    const int64_t now = time(nullptr);
    constexpr int64_t kHour = 3600;
    while (const dirent* found = readdir(list)) {
        struct stat status {};  // another process may remove files at the same time
        if (fstatat(descriptor, found->d_name, &status, AT_SYMLINK_NOFOLLOW) != 0) continue;
        if (!S_ISREG(status.st_mode)) continue;
        const std::string name = found->d_name;
        const auto& [seconds, nanoseconds] = status.st_mtim;
        // Such a file is left from a process that was killed while it wrote, maybe on another host.
        if (is_temporary(name) && (ends_with_dead_tag(name) || now - seconds > kHour))
            unlinkat(descriptor, name.c_str(), 0);
        else if (!is_temporary(name))
            entries.push_back(
                {name, seconds * 1'000'000'000 + nanoseconds, uint64_t(status.st_size)});
        total += uint64_t(status.st_size);
    }
    std::ranges::sort(entries, {}, &Entry::used);
    for (const Entry& entry : entries) {
        if (total <= max_bytes_) break;
        unlinkat(descriptor, entry.name.c_str(), 0);
        total -= entry.bytes;
    }
    closedir(list);
}

}  // namespace voxelume
