// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/companion_file.hpp"

#include <algorithm>

namespace voxelume {
namespace {

namespace fs = std::filesystem;

bool leads_out(const fs::path& name, const std::string& text) {
    const bool has_drive = text.size() > 1 && text[1] == ':';
    return name.is_absolute() || has_drive || std::ranges::find(name, "..") != name.end();
}

/// The path of a regular file, unless a link leads out of the folder.
std::optional<fs::path> file_below(const fs::path& folder, const fs::path& name) {
    std::error_code error;
    const fs::path root = fs::canonical(folder.empty() ? fs::path(".") : folder, error);
    if (error || name.empty()) return {};
    fs::path file = fs::canonical(root / name, error);
    if (error || !fs::is_regular_file(file, error)) return {};
    const auto [in_root, in_file] =
        std::mismatch(root.begin(), root.end(), file.begin(), file.end());
    if (in_root != root.end() || in_file == file.end()) return {};
    return file;
}

}  // namespace

std::optional<fs::path> companion_file(const fs::path& of, std::string name) {
    if (name.find('\0') != std::string::npos) return {};
    std::ranges::replace(name, '\\', '/');
    const fs::path path(name);
    const fs::path folder = of.parent_path();
    if (!leads_out(path, name))
        if (auto file = file_below(folder, path)) return file;
    return file_below(folder, path.filename());
}

}  // namespace voxelume
