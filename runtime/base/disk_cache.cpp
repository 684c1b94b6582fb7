// SPDX-License-Identifier: Apache-2.0
#include "runtime/base/disk_cache.hpp"

#include <fmt/format.h>
#include <unistd.h>
#include <xxhash.h>

#include <algorithm>
#include <atomic>
#include <cerrno>
#include <chrono>
#include <cstdlib>
#include <cstring>
#include <fstream>
#include <system_error>

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

std::string whole_file(const fs::path& path) {
    std::ifstream file(path, std::ios::binary | std::ios::ate);
    if (!file) return {};
    std::string text(static_cast<size_t>(file.tellg()), '\0');
    file.seekg(0);
    file.read(text.data(), static_cast<std::streamsize>(text.size()));
    text.resize(static_cast<size_t>(file.gcount()));
    return text;
}

bool is_temporary(const fs::path& path) {
    return path.filename().string().starts_with('.');
}

fs::path environment_path(const char* name) {
    const char* value = std::getenv(name);
    return value ? fs::path(value) : fs::path();
}

}  // namespace

fs::path cache_folder() {
    if (std::getenv("VOXELUME_CACHE_DIR")) return environment_path("VOXELUME_CACHE_DIR");
    const fs::path shared = environment_path("XDG_CACHE_HOME");
    if (shared.is_absolute()) return shared / "voxelume";
    const fs::path home = environment_path("HOME");
    return home.is_absolute() ? home / ".cache" / "voxelume" : fs::path();
}

std::string cache_key(std::span<const std::string_view> parts) {
    std::string text;
    for (const std::string_view part : parts) {
        text += fmt::format("{}:", part.size());
        text += part;
    }
    const XXH128_hash_t hash = XXH3_128bits(text.data(), text.size());
    return fmt::format("{:016x}{:016x}", hash.high64, hash.low64);
}

std::optional<std::string> DiskCache::read(const std::string& key) const noexcept try {
    if (folder_.empty()) return std::nullopt;
    const fs::path path = folder_ / key;
    std::string entry = whole_file(path);
    if (entry.empty()) return std::nullopt;
    Header found = {};
    std::memcpy(&found, entry.data(), std::min(entry.size(), sizeof found));
    const std::string_view bytes =
        std::string_view(entry).substr(std::min(entry.size(), sizeof found));
    const Header expected = header_of(key, bytes);
    std::error_code ignored;
    if (std::memcmp(&found, &expected, sizeof found) != 0) {
        fs::remove(path, ignored);
        return std::nullopt;
    }
    fs::last_write_time(path, fs::file_time_type::clock::now(), ignored);
    entry.erase(0, sizeof found);
    return entry;
} catch (const std::exception&) {
    return std::nullopt;
}

void DiskCache::write(const std::string& key, std::string_view bytes) const noexcept try {
    if (folder_.empty()) return;
    static std::atomic<int> number = 0;
    fs::create_directories(folder_);
    const fs::path temporary = folder_ / fmt::format(".{}-{}-{}", key, getpid(), number++);
    const Header header = header_of(key, bytes);
    std::ofstream file(temporary, std::ios::binary);
    file.write(reinterpret_cast<const char*>(&header), sizeof header);
    file.write(bytes.data(), static_cast<std::streamsize>(bytes.size()));
    file.close();
    std::error_code failed;
    if (file) fs::rename(temporary, folder_ / key, failed);
    if (!file || failed) fs::remove(temporary, failed);
    trim();
} catch (const std::exception&) {
    return;  // the next run computes it again
}

std::string DiskCache::refusal() const {
    std::error_code error;
    fs::path existing = fs::absolute(folder_, error);
    if (folder_.empty() || error) return {};
    // A folder that doesn't exist is made in the nearest one above it that does.
    while (!fs::exists(existing, error) && !error && existing.has_relative_path())
        existing = existing.parent_path();
    if (error) return error.message();
    if (!fs::is_directory(existing, error)) return std::strerror(ENOTDIR);
    return access(existing.c_str(), W_OK | X_OK) == 0 ? "" : std::strerror(errno);
}

void DiskCache::trim() const {
    struct Entry {
        fs::path path;
        fs::file_time_type used;
        uint64_t bytes;
    };
    std::vector<Entry> entries;
    uint64_t total = 0;
    std::error_code error;  // another process may remove files at the same time
    const auto now = fs::file_time_type::clock::now();
    for (const fs::directory_entry& file : fs::directory_iterator(folder_, error)) {
        const fs::file_time_type used = file.last_write_time(error);
        const uintmax_t bytes = error ? 0 : file.file_size(error);
        if (error) continue;
        // Such a file is left from a process that was killed while it wrote.
        if (is_temporary(file.path()) && now - used > std::chrono::hours(1))
            fs::remove(file.path(), error);
        else if (!is_temporary(file.path()))
            entries.push_back({file.path(), used, bytes});
        total += bytes;
    }
    std::ranges::sort(entries, {}, &Entry::used);
    for (const Entry& entry : entries) {
        if (total <= max_bytes_) return;
        fs::remove(entry.path, error);
        total -= entry.bytes;
    }
}

}  // namespace voxelume
