// SPDX-License-Identifier: Apache-2.0
// Voxels -> MagicaVoxel's .vox; io/voxels/vox_file.hpp describes the format. Parts of 256 voxels
// stand side by side in the scene graph.
#include <algorithm>
#include <array>
#include <map>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/io/voxel_art/median_cut.hpp"

namespace voxelume {
namespace {

constexpr int kPartSide = 256;
constexpr size_t kMaxParts = 20'000;
constexpr size_t kMaxColors = 255;

void add_int(std::string& bytes, int32_t value) {
    bytes.append(reinterpret_cast<const char*>(&value), sizeof value);
}

void add_text(std::string& bytes, const std::string& text) {
    add_int(bytes, int32_t(text.size()));
    bytes += text;
}

void add_chunk(std::string& bytes, const char* letters, const std::string& content) {
    bytes += letters;
    add_int(bytes, int32_t(content.size()));
    add_int(bytes, 0);
    bytes += content;
}

/// A part of the voxels, in the file's axes: Z up, and y away from the front.
struct VoxPart {
    glm::ivec3 low{1 << 30}, high{-(1 << 30)};  ///< one past the last
    std::vector<std::pair<glm::ivec3, uint8_t>> voxels;
};

glm::ivec3 floor_parts(const glm::ivec3& cell) {
    return {cell.x >> 8, cell.y >> 8, cell.z >> 8};
}

Palette palette_of(const CubeList& cubes) {
    std::map<uint32_t, uint64_t> counts;
    if (cubes.colors.empty()) counts[0xFFFFFF] = cubes.cells.size();
    for (const uint32_t color : cubes.colors) ++counts[color & 0xFFFFFF];
    return median_cut(counts, kMaxColors);
}

using Parts = std::map<std::array<int, 3>, VoxPart>;

Parts parts_of(const CubeList& cubes, const Palette& palette) {
    Parts parts;
    for (size_t i = 0; i < cubes.cells.size(); ++i) {
        const glm::ivec3& c = cubes.cells[i];
        const glm::ivec3 v(c.x, -1 - c.z, c.y), p = floor_parts(v);
        VoxPart& part = parts[{p.x, p.y, p.z}];
        part.low = glm::min(part.low, v);
        part.high = glm::max(part.high, v + 1);
        const uint32_t color = cubes.colors.empty() ? 0xFFFFFF : cubes.colors[i] & 0xFFFFFF;
        part.voxels.emplace_back(v, uint8_t(palette.numbers.at(color) + 1));
    }
    static_assert(kPartSide == 1 << 8);
    for (auto& [place, part] : parts)
        std::ranges::sort(part.voxels, {}, [](const auto& voxel) {
            return std::array{voxel.first.z, voxel.first.y, voxel.first.x};
        });
    if (parts.size() > kMaxParts)
        throw Error(ErrorKind::limit, "a .vox of {} models is more than {}; use larger voxels",
                    parts.size(), kMaxParts);
    return parts;
}

void add_model(std::string& bytes, const VoxPart& part) {
    std::string size, voxels;
    const glm::ivec3 edges = part.high - part.low;
    for (int axis = 0; axis < 3; ++axis) add_int(size, edges[axis]);
    add_int(voxels, int32_t(part.voxels.size()));
    for (const auto& [cell, number] : part.voxels) {
        const glm::ivec3 v = cell - part.low;
        voxels += {char(v.x), char(v.y), char(v.z), char(number)};
    }
    add_chunk(bytes, "SIZE", size);
    add_chunk(bytes, "XYZI", voxels);
}

/// A node of a transform, with a place where it has one.
std::string transform(int node, int child, const std::string& place) {
    std::string content;
    for (const int value : {node, 0, child, -1, 0, 1}) add_int(content, value);
    add_int(content, place.empty() ? 0 : 1);
    if (!place.empty()) {
        add_text(content, "_t");
        add_text(content, place);
    }
    return content;
}

void add_graph(std::string& bytes, const Parts& parts) {
    add_chunk(bytes, "nTRN", transform(0, 1, ""));
    std::string group;
    for (const int value : {1, 0, int(parts.size())}) add_int(group, value);
    for (int i = 0; i < int(parts.size()); ++i) add_int(group, 2 + 2 * i);
    add_chunk(bytes, "nGRP", group);
    int model = 0;
    for (const auto& [place, part] : parts) {
        // The corner of voxel floor(size / 2) stands there.
        const glm::ivec3 t = part.low + (part.high - part.low) / 2;
        add_chunk(bytes, "nTRN",
                  transform(2 + 2 * model, 3 + 2 * model, fmt::format("{} {} {}", t.x, t.y, t.z)));
        std::string shape;
        for (const int value : {3 + 2 * model, 0, 1, model, 0}) add_int(shape, value);
        add_chunk(bytes, "nSHP", shape);
        ++model;
    }
}

}  // namespace

WriterNotes write_vox(const std::filesystem::path& path, const CubeList& cubes) {
    const Palette palette = palette_of(cubes);
    const Parts parts = parts_of(cubes, palette);
    std::string inside;
    for (const auto& [place, part] : parts) add_model(inside, part);
    add_graph(inside, parts);
    std::string colors;
    for (size_t i = 0; i < 256; ++i)
        add_int(colors,
                int32_t(i < palette.colors.size() ? palette.colors[i] | 0xFF000000u : 0xFF000000u));
    add_chunk(inside, "RGBA", colors);
    std::string start = "VOX ";
    add_int(start, 150);
    start += "MAIN";
    add_int(start, 0);
    add_int(start, int32_t(inside.size()));
    if (inside.size() > 0x7FFFFFFF)
        throw Error(ErrorKind::limit, "{} voxels are more than a .vox can hold",
                    cubes.cells.size());
    AtomicFile file(path);
    file.write(start.data(), start.size());
    file.write(inside.data(), inside.size());
    file.commit();
    WriterNotes notes;
    if (parts.size() > 1)
        notes.push_back(fmt::format("{} models of {} voxels a side stand side by side",
                                    parts.size(), kPartSide));
    if (palette.numbers.size() > palette.colors.size() || palette.numbers.size() > kMaxColors)
        notes.push_back(fmt::format("{} colours became {} by median cut", palette.numbers.size(),
                                    palette.colors.size()));
    const auto is_clear = [](uint32_t color) { return color >> 24 != 0; };
    if (std::ranges::any_of(cubes.colors, is_clear))
        notes.emplace_back("transparent voxels became opaque");
    return notes;
}

}  // namespace voxelume
