// SPDX-License-Identifier: Apache-2.0
// glTF files that tests write: one buffer, accessors for arrays, and whatever else they add.
#pragma once

#include <nlohmann/json.hpp>

#include <bit>
#include <cstdint>
#include <cstring>
#include <string>
#include <vector>

namespace voxelume {

class GltfWriter {
  public:
    GltfWriter() { json["asset"]["version"] = "2.0"; }

    /// Appends the bytes of values and a buffer view of them. Returns its number.
    template <class T>
    int view(const std::vector<T>& values, int stride = 0) {
        while (bytes.size() % 4 != 0) bytes += '\0';
        const size_t offset = bytes.size();
        bytes.append(reinterpret_cast<const char*>(values.data()), values.size() * sizeof(T));
        json["bufferViews"].push_back(
            {{"buffer", 0}, {"byteOffset", offset}, {"byteLength", values.size() * sizeof(T)}});
        if (stride > 0) json["bufferViews"].back()["byteStride"] = stride;
        return int(json["bufferViews"].size()) - 1;
    }

    /// Appends an accessor of values. Returns its number.
    template <class T>
    int accessor(const std::vector<T>& values, const std::string& type, int components,
                 bool is_normalized = false) {
        json["accessors"].push_back({{"bufferView", view(values)},
                                     {"componentType", component_type<T>()},
                                     {"count", values.size() / size_t(components)},
                                     {"type", type}});
        if (is_normalized) json["accessors"].back()["normalized"] = true;
        return int(json["accessors"].size()) - 1;
    }

    /// Makes the scene one mesh of material 0, by the numbers of its accessors.
    void show(int positions, int uvs, int indices) {
        const nlohmann::json attributes = {{"POSITION", positions}, {"TEXCOORD_0", uvs}};
        json["meshes"] = {
            {{"primitives",
              {{{"attributes", attributes}, {"indices", indices}, {"material", 0}}}}}};
        json["nodes"] = {{{"mesh", 0}}};
        json["scenes"] = {{{"nodes", {0}}}};
    }

    /// The file as .gltf, with its buffer as a data URI.
    std::string gltf() const {
        nlohmann::json whole = json;
        if (!bytes.empty())
            whole["buffers"] = {{{"byteLength", bytes.size()},
                                 {"uri", "data:application/octet-stream;base64," + base64(bytes)}}};
        return whole.dump();
    }

    /// The file as .glb. Its own buffer, if it has bytes, is the only one.
    std::string glb() const {
        nlohmann::json whole = json;
        if (!bytes.empty()) whole["buffers"] = {{{"byteLength", bytes.size()}}};
        std::string text = whole.dump(), binary = bytes;
        while (text.size() % 4 != 0) text += ' ';
        while (binary.size() % 4 != 0) binary += '\0';
        return "glTF" + word(2) + word(uint32_t(28 + text.size() + binary.size())) +
               word(uint32_t(text.size())) + "JSON" + text + word(uint32_t(binary.size())) +
               std::string("BIN\0", 4) + binary;
    }

    static std::string word(uint32_t value) {
        std::string out;
        for (int i = 0; i < 4; ++i) out += char(value >> 8 * i & 255);
        return out;
    }

    static std::string base64(const std::string& data) {
        constexpr const char* kDigits =
            "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
        std::string out;
        for (size_t i = 0; i < data.size(); i += 3) {
            uint32_t bits = 0;
            for (size_t k = 0; k < 3; ++k)
                bits = bits << 8 | (i + k < data.size() ? uint8_t(data[i + k]) : 0);
            for (size_t k = 0; k < 4; ++k)
                out += k > data.size() - i ? '=' : kDigits[bits >> (18 - 6 * k) & 63];
        }
        return out;
    }

    template <class T>
    static int component_type() {
        if constexpr (std::is_same_v<T, float>) return 5126;
        constexpr int kSize = sizeof(T) == 1 ? 5120 : sizeof(T) == 2 ? 5122 : 5124;
        return kSize + std::is_unsigned_v<T>;
    }

    nlohmann::json json;
    std::string bytes;
};

/// A triangle of the corners (0,0,0), (7,0,0), (0,5,3), as mesh 0 of node 0.
inline GltfWriter triangle_gltf() {
    GltfWriter writer;
    const int positions = writer.accessor(std::vector<float>{0, 0, 0, 7, 0, 0, 0, 5, 3}, "VEC3", 3);
    writer.json["meshes"] = {{{"primitives", {{{"attributes", {{"POSITION", positions}}}}}}}};
    writer.json["nodes"] = {{{"mesh", 0}}};
    writer.json["scenes"] = {{{"nodes", {0}}}};
    return writer;
}

}  // namespace voxelume
