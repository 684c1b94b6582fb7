// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/volume/volume_page.hpp"

#include <fmt/format.h>
#include <zlib.h>

#include <algorithm>
#include <cmath>
#include <nlohmann/json.hpp>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/base/files/stamp.hpp"
#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/png.hpp"

namespace voxelume {
namespace {

/// Voxels, or cubic blocks of voxels, as the page stores them.
struct PageVoxels {
    std::vector<glm::u16vec3> cells;
    std::vector<glm::vec4> colors;  ///< linear colour, multiplied by the opacity; then the opacity
    int merged = 1;                 ///< voxels along a block's edge
};

PageVoxels shown_voxels(const Volume& volume) {
    PageVoxels voxels;
    for (size_t i = 0; i < volume.indices.size(); ++i) {
        const float opacity = volume.opacities[i];
        if (!(opacity > 0) || volume.kinds[i] == VoxelKind::unseen) continue;
        voxels.cells.emplace_back(cell_of(volume.frame, volume.indices[i]));
        voxels.colors.emplace_back(volume.colors[i] * opacity, opacity);
    }
    return voxels;
}

uint64_t key_of(const glm::u16vec3& cell) {
    return uint64_t(cell.z) << 32 | uint64_t(cell.y) << 16 | cell.x;
}

/// Merges into blocks of twice the edge, with the mean colour of their parts and the opacity of the
/// most opaque part.
PageVoxels merge(const PageVoxels& voxels) {
    std::vector<std::pair<uint64_t, uint32_t>> order;
    order.reserve(voxels.cells.size());
    for (size_t i = 0; i < voxels.cells.size(); ++i)
        order.emplace_back(key_of(voxels.cells[i] / uint16_t(2)), uint32_t(i));
    std::ranges::sort(order);
    PageVoxels blocks;
    blocks.merged = voxels.merged * 2;
    for (size_t first = 0, end = 0; first < order.size(); first = end) {
        glm::vec4 sum(0);
        float maximum = 0;
        for (; end < order.size() && order[end].first == order[first].first; ++end) {
            const glm::vec4& color = voxels.colors[order[end].second];
            sum += color;
            maximum = std::max(maximum, color.a);
        }
        blocks.cells.push_back(voxels.cells[order[first].second] / uint16_t(2));
        blocks.colors.push_back(sum * (maximum / sum.a));
    }
    return blocks;
}

/// Packs the cells' x, then y, then z, 16 bits each; then red, green, blue (sRGB) and opacity, 8
/// bits each.
std::vector<uint8_t> pack(const PageVoxels& voxels, float exposure) {
    std::vector<uint8_t> bytes;
    bytes.reserve(voxels.cells.size() * 10);
    for (int axis = 0; axis < 3; ++axis)
        for (const glm::u16vec3& cell : voxels.cells) {
            bytes.push_back(uint8_t(cell[axis] & 255));
            bytes.push_back(uint8_t(cell[axis] >> 8));
        }
    const float gain = std::exp2(exposure);
    for (const glm::vec4& color : voxels.colors) {
        for (int c = 0; c < 3; ++c) bytes.push_back(srgb_code(color[c] / color.a * gain));
        bytes.push_back(uint8_t(std::clamp(std::lround(color.a * 255.0f), 1L, 255L)));
    }
    return bytes;
}

std::vector<uint8_t> compress(AtomicFile& file, const std::vector<uint8_t>& bytes) {
    uLongf size = compressBound(uLong(bytes.size()));
    std::vector<uint8_t> packed(size);
    if (compress2(packed.data(), &size, bytes.data(), uLong(bytes.size()), 6) != Z_OK)
        file.fail("its voxels can't be compressed");
    packed.resize(size);
    return packed;
}

std::string base64(const std::vector<uint8_t>& bytes) {
    constexpr std::string_view kDigits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string text;
    text.reserve((bytes.size() + 2) / 3 * 4);
    for (size_t i = 0; i < bytes.size(); i += 3) {
        uint32_t three = 0;
        for (size_t n = 0; n < 3; ++n)
            three = three << 8 | (i + n < bytes.size() ? bytes[i + n] : 0u);
        for (size_t n = 0; n < 4; ++n)
            text += i + n > bytes.size() ? '=' : kDigits[three >> (18 - 6 * n) & 63];
    }
    return text;
}

/// The values that the script's `point` needs.
std::string frame_json(const Volume& volume, const PageVoxels& voxels, const PageOptions& options) {
    const VolumeFrame& frame = volume.frame;
    const Display& display = frame.display;
    const glm::dvec2 half = half_extent(display);
    nlohmann::ordered_json json;
    json["layout"] = frame.layout == VolumeLayout::lattice ? "lattice" : "rays";
    json["shape"] = shape_row(display).name;
    json["size"] = {frame.size.x, frame.size.y, frame.size.z};
    json["origin"] = {frame.origin.x, frame.origin.y, frame.origin.z};
    json["edge"] = {frame.edge.x, frame.edge.y, frame.edge.z};
    json["half"] = {half.x, half.y};
    json["near"] = display.near;
    json["step"] = frame.step;
    json["count"] = voxels.cells.size();
    json["merged"] = voxels.merged;
    json["around"] = options.view.around;
    json["above"] = options.view.above;
    return json.dump();
}

std::string escape_html(const std::string& text) {
    std::string escaped;
    for (const char c : text) {
        if (c == '<' || c == '>' || c == '&')
            escaped += fmt::format("&#{};", int(c));
        else
            escaped += c;
    }
    return escaped;
}

std::string title_of(const Volume& volume) {
    const glm::ivec3& size = volume.frame.size;
    const auto scene = volume.attributes.find("scene");
    return fmt::format("{}{} x {} x {} voxels, {} shown",
                       scene == volume.attributes.end() ? "" : escape_html(scene->second) + ": ",
                       size.x, size.y, size.z, volume.indices.size());
}

}  // namespace

void write_volume_page(const std::filesystem::path& path, const Volume& volume,
                       const PageOptions& options) {
    AtomicFile file(path);
    PageVoxels voxels = shown_voxels(volume);
    while (voxels.cells.size() > kMaxPageVoxels) voxels = merge(voxels);
    const std::string data = base64(compress(file, pack(voxels, options.exposure)));
    const std::string frame = frame_json(volume, voxels, options), title = title_of(volume);
    const std::string stamp = stamp_of(kNoFrame);
    // Replaces each @NAME@ in the page's text.
    std::string_view rest = page_text();
    while (!rest.empty()) {
        const size_t mark = rest.find('@'), end = rest.find('@', mark + 1);
        const std::string_view before = rest.substr(0, mark);
        file.write(before.data(), before.size());
        if (mark == std::string_view::npos) break;
        const std::string_view name = rest.substr(mark + 1, end - mark - 1);
        const std::string_view text = name == "STAMP"    ? std::string_view(stamp)
                                      : name == "TITLE"  ? std::string_view(title)
                                      : name == "FRAME"  ? std::string_view(frame)
                                      : name == "VOXELS" ? std::string_view(data)
                                                         : page_script();
        file.write(text.data(), text.size());
        rest.remove_prefix(end + 1);
    }
    file.commit();
}

}  // namespace voxelume
