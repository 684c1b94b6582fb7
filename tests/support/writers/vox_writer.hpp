// SPDX-License-Identifier: Apache-2.0
// Writes MagicaVoxel files for tests, byte by byte, without the program's own code.
#pragma once

#include <array>
#include <cstdint>
#include <cstring>
#include <string>
#include <utility>
#include <vector>

namespace voxelume {

using VoxPairs = std::vector<std::pair<std::string, std::string>>;

class VoxWriter {
  public:
    using Voxel = std::array<uint8_t, 4>;  ///< x, y, z, palette index

    static std::string number(int32_t value) {
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &value, 4);
        return bytes;
    }
    static std::string number(float value) {
        std::string bytes(4, '\0');
        std::memcpy(bytes.data(), &value, 4);
        return bytes;
    }
    static std::string text(const std::string& value) {
        return number(int32_t(value.size())) + value;
    }
    static std::string dictionary(const VoxPairs& pairs) {
        std::string bytes = number(int32_t(pairs.size()));
        for (const auto& [key, value] : pairs) bytes += text(key) + text(value);
        return bytes;
    }

    void chunk(const std::string& letters, const std::string& content) {
        chunks_ += letters + number(int32_t(content.size())) + number(0) + content;
    }
    void model(std::array<int, 3> size, const std::vector<Voxel>& voxels) {
        chunk("SIZE", number(size[0]) + number(size[1]) + number(size[2]));
        std::string content = number(int32_t(voxels.size()));
        for (const Voxel& voxel : voxels)
            content.append(reinterpret_cast<const char*>(voxel.data()), 4);
        chunk("XYZI", content);
    }
    /// A colour for each palette index from 1 on; 0xAABBGGRR.
    void palette(const std::array<uint32_t, 256>& colors) {
        std::string content;
        for (size_t i = 1; i < 256; ++i) content += number(int32_t(colors[i]));
        chunk("RGBA", content + number(0));
    }
    void transform(int node, int child, int layer, const VoxPairs& attributes,
                   const std::vector<VoxPairs>& frames) {
        std::string content = number(node) + dictionary(attributes) + number(child) + number(-1) +
                              number(layer) + number(int32_t(frames.size()));
        for (const VoxPairs& frame : frames) content += dictionary(frame);
        chunk("nTRN", content);
    }
    void group(int node, const std::vector<int>& children, const VoxPairs& attributes = {}) {
        std::string content =
            number(node) + dictionary(attributes) + number(int32_t(children.size()));
        for (const int child : children) content += number(child);
        chunk("nGRP", content);
    }
    void shape(int node, const std::vector<std::pair<int, VoxPairs>>& models) {
        std::string content = number(node) + dictionary({}) + number(int32_t(models.size()));
        for (const auto& [model, attributes] : models)
            content += number(model) + dictionary(attributes);
        chunk("nSHP", content);
    }
    void layer(int layer, const VoxPairs& attributes) {
        chunk("LAYR", number(layer) + dictionary(attributes) + number(-1));
    }
    void material(int entry, const VoxPairs& values) {
        chunk("MATL", number(entry) + dictionary(values));
    }

    std::string bytes(int version = 150) const {
        return "VOX " + number(version) + "MAIN" + number(0) + number(int32_t(chunks_.size())) +
               chunks_;
    }

  private:
    std::string chunks_;
};

}  // namespace voxelume
