// SPDX-License-Identifier: Apache-2.0
#include "runtime/opencl/source/packed_files.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <charconv>
#include <fstream>
#include <iterator>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

constexpr size_t kMaxName = 1000, kMaxDepth = 8;

bool is_plain_character(char c) {
    return (c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
           c == '-' || c == '.';
}

/// A name of letters and digits that isn't hidden and doesn't lead upward.
bool is_plain_name(std::string_view name) {
    return !name.empty() && name.front() != '.' && std::ranges::all_of(name, is_plain_character);
}

/// PoCL's paths: two letters of a hash, the rest, a kernel, its variant, its file.
bool is_safe_path(std::string_view path) {
    if (path.size() > kMaxName) return false;
    for (size_t depth = 0; depth < kMaxDepth; ++depth) {
        const size_t slash = path.find('/');
        const std::string_view name = path.substr(0, slash);
        if (!is_plain_name(name)) return false;
        if (slash == std::string_view::npos)
            return name == "program.bc" || name == "build.log" || name.ends_with(".so");
        path.remove_prefix(slash + 1);
    }
    return false;
}

/// Removes the digits before `end`, and `end` itself, from the start of the text.
size_t take_size(std::string_view& text, char end) {
    size_t size = 0;
    const auto [stop, error] = std::from_chars(text.data(), text.data() + text.size(), size);
    const auto digits = size_t(stop - text.data());
    if (error != std::errc() || digits == text.size() || *stop != end)
        throw PackedFileError("a file without a size");
    text.remove_prefix(digits + 1);
    return size;
}

}  // namespace

std::string packed(const fs::path& root, std::span<const fs::path> files) {
    std::string bytes;
    for (const fs::path& path : files) {
        std::ifstream file(root / path, std::ios::binary);
        const std::string text(std::istreambuf_iterator<char>(file), {});
        bytes += fmt::format("{} {}\n{}", text.size(), path.string(), text);
    }
    return bytes;
}

std::vector<std::pair<std::string, std::string_view>> packed_files(std::string_view bytes) {
    std::vector<std::pair<std::string, std::string_view>> files;
    while (!bytes.empty()) {
        const size_t size = take_size(bytes, ' '), end = bytes.find('\n');
        if (end == std::string_view::npos || !is_safe_path(bytes.substr(0, end)))
            throw PackedFileError("a file of a wrong name");
        std::string name(bytes.substr(0, end));
        bytes.remove_prefix(end + 1);
        if (size > bytes.size()) throw PackedFileError("a file that is cut off");
        files.emplace_back(std::move(name), bytes.substr(0, size));
        bytes.remove_prefix(size);
    }
    return files;
}

}  // namespace voxelume
