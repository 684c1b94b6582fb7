// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/mesh/material_library.hpp"

#include <algorithm>
#include <fstream>

namespace voxelume {
namespace {

constexpr int kMaxLines = 100000;

}  // namespace

bool names_textures(const std::filesystem::path& mesh, const std::string& name) {
    const std::filesystem::path relative(name);
    const bool leads_out = std::ranges::find(relative, "..") != relative.end();
    const std::filesystem::path file = mesh.parent_path() / relative;
    std::error_code error;
    if (relative.is_absolute() || leads_out || !std::filesystem::is_regular_file(file, error))
        return false;
    std::ifstream stream(file);
    std::string word, rest;
    for (int line = 0; line < kMaxLines && stream >> word; ++line) {
        if (word.starts_with("map_")) return true;
        std::getline(stream, rest);
    }
    return false;
}

}  // namespace voxelume
