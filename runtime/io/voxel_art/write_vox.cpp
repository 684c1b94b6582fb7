// SPDX-License-Identifier: Apache-2.0
// Voxels -> MagicaVoxel's .vox; io/voxels/vox_file.hpp describes the format. Parts of 256 voxels
// stand side by side in the scene graph.
#include <algorithm>
#include <array>
#include <map>
#include <set>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/io/voxel_art/cube_list.hpp"
#include "runtime/io/voxel_art/median_cut.hpp"
#include "runtime/io/voxels/vox_materials.hpp"

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
    glm::ivec3 low{1 << 30}, high{-(1 << 30)};  ///< `high` is one past the last
    std::vector<std::pair<glm::ivec3, uint8_t>> voxels;
};

glm::ivec3 floor_parts(const glm::ivec3& cell) {
    return {cell.x >> 8, cell.y >> 8, cell.z >> 8};
}

/// A material's number and a colour of its voxels, 0xBBGGRR. Number 0 stands for all plain
/// materials.
using Paint = std::pair<size_t, uint32_t>;

Paint paint_of(const CubeList& cubes, size_t voxel) {
    const size_t material = cubes.material_numbers.empty() ? 0 : cubes.material_numbers[voxel];
    const uint32_t own = cubes.colors.empty() ? 0xFFFFFF : cubes.colors[voxel] & 0xFFFFFF;
    if (material >= cubes.materials.size()) return {0, own};
    const CubeMaterial& of = cubes.materials[material];
    const bool is_plain = of.vox.kind == VoxMaterialKind::diffuse;
    return {is_plain ? 0 : material + 1, of.color.value_or(own)};
}

/// The file's colours, and the material of each.
struct VoxPalette {
    std::vector<uint32_t> colors;
    std::vector<size_t> materials;
    std::map<Paint, size_t> indices;
};

/// The palette; each material gets a share of the colours.
VoxPalette palette_of(const CubeList& cubes) {
    std::map<size_t, std::map<uint32_t, uint64_t>> counts;
    for (size_t i = 0; i < cubes.cells.size(); ++i) {
        const Paint paint = paint_of(cubes, i);
        ++counts[paint.first][paint.second];
    }
    size_t all = 0;
    for (const auto& [material, colors] : counts) all += colors.size();
    const size_t spare = kMaxColors - counts.size(), further = all - counts.size();
    VoxPalette palette;
    for (const auto& [material, colors] : counts) {
        const size_t share =
            all <= kMaxColors ? colors.size() : 1 + spare * (colors.size() - 1) / further;
        const Palette own = median_cut(colors, share);
        for (const auto& [color, number] : own.numbers)
            palette.indices[{material, color}] = palette.colors.size() + number;
        palette.colors.insert(palette.colors.end(), own.colors.begin(), own.colors.end());
        palette.materials.resize(palette.colors.size(), material);
    }
    return palette;
}

/// Adds a chunk MATL for each colour whose material is more than a colour.
void add_materials(std::string& bytes, const CubeList& cubes, const VoxPalette& palette) {
    for (size_t i = 0; i < palette.colors.size(); ++i) {
        if (palette.materials[i] == 0) continue;
        const VoxDictionary values = values_of(cubes.materials[palette.materials[i] - 1].vox);
        std::string content;
        add_int(content, int32_t(i + 1));
        add_int(content, int32_t(values.size()));
        for (const auto& [key, value] : values) {
            add_text(content, key);
            add_text(content, value);
        }
        add_chunk(bytes, "MATL", content);
    }
}

using Parts = std::map<std::array<int, 3>, VoxPart>;

Parts parts_of(const CubeList& cubes, const VoxPalette& palette) {
    Parts parts;
    for (size_t i = 0; i < cubes.cells.size(); ++i) {
        const glm::ivec3& c = cubes.cells[i];
        const glm::ivec3 v(c.x, -1 - c.z, c.y), p = floor_parts(v);
        VoxPart& part = parts[{p.x, p.y, p.z}];
        part.low = glm::min(part.low, v);
        part.high = glm::max(part.high, v + 1);
        part.voxels.emplace_back(v, uint8_t(palette.indices.at(paint_of(cubes, i)) + 1));
    }
    static_assert(kPartSide == 1 << 8);
    for (auto& [position, part] : parts)
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

/// A transform node, with a translation unless `translation` is empty.
std::string transform(int node, int child, const std::string& translation) {
    std::string content;
    for (const int value : {node, 0, child, -1, 0, 1}) add_int(content, value);
    add_int(content, translation.empty() ? 0 : 1);
    if (!translation.empty()) {
        add_text(content, "_t");
        add_text(content, translation);
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
    for (const auto& [position, part] : parts) {
        // The translation is that of the corner of voxel floor(size / 2).
        const glm::ivec3 t = part.low + (part.high - part.low) / 2;
        add_chunk(bytes, "nTRN",
                  transform(2 + 2 * model, 3 + 2 * model, fmt::format("{} {} {}", t.x, t.y, t.z)));
        std::string shape;
        for (const int value : {3 + 2 * model, 0, 1, model, 0}) add_int(shape, value);
        add_chunk(bytes, "nSHP", shape);
        ++model;
    }
}

/// True if the materials leave no colour for plain voxels.
bool has_too_many_materials(const CubeList& cubes) {
    std::set<size_t> numbers;
    for (size_t i = 0; i < cubes.material_numbers.size(); ++i)
        numbers.insert(paint_of(cubes, i).first);
    return numbers.size() > kMaxColors;
}

}  // namespace

WriterNotes write_vox(const std::filesystem::path& path, const CubeList& cubes) {
    if (has_too_many_materials(cubes)) {
        CubeList plain = cubes;
        plain.materials.clear();
        WriterNotes notes = write_vox(path, plain);
        notes.push_back(
            fmt::format("its materials became plain colours, since there are more than "
                        "{}",
                        kMaxColors));
        return notes;
    }
    const VoxPalette palette = palette_of(cubes);
    const Parts parts = parts_of(cubes, palette);
    std::string inside;
    for (const auto& [position, part] : parts) add_model(inside, part);
    add_graph(inside, parts);
    std::string colors;
    for (size_t i = 0; i < 256; ++i)
        add_int(colors,
                int32_t(i < palette.colors.size() ? palette.colors[i] | 0xFF000000u : 0xFF000000u));
    add_chunk(inside, "RGBA", colors);
    add_materials(inside, cubes, palette);
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
    if (palette.indices.size() > palette.colors.size())
        notes.push_back(fmt::format("{} colours became {} by median cut", palette.indices.size(),
                                    palette.colors.size()));
    const auto is_cut = [&](size_t material) {
        return material > 0 && cubes.materials[material - 1].vox.is_flux_cut;
    };
    if (std::ranges::any_of(palette.materials, is_cut))
        notes.emplace_back("emission above 81 became 81, which is MagicaVoxel's flux 8");
    const auto is_clear = [](uint32_t color) { return color >> 24 != 0; };
    if (std::ranges::any_of(cubes.colors, is_clear))
        notes.emplace_back("transparent voxels became opaque");
    return notes;
}

}  // namespace voxelume
