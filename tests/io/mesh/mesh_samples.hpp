// SPDX-License-Identifier: Apache-2.0
// One small mesh in every format that can be read, written by code that shares nothing with the
// readers.
#pragma once

#include <fmt/format.h>

#include <bit>
#include <cstdint>
#include <string>
#include <vector>

namespace voxelume::samples {

/// A pyramid over a 5 x 3 rectangle, in which no axis can be mistaken for another. The vertices are
/// in the order in which the triangles first name them, as in STL.
struct Pyramid {
    double positions[5][3] = {{0.5, 0.25, -1.0},
                              {5.5, 0.25, -1.0},
                              {1.75, 1.5, 6.125},
                              {5.5, 3.25, -1.0},
                              {0.5, 3.25, -1.0}};
    uint32_t triangles[6][3] = {{0, 1, 2}, {1, 3, 2}, {3, 4, 2}, {4, 0, 2}, {0, 4, 3}, {0, 3, 1}};
    int colors[5][3] = {{255, 0, 0}, {0, 51, 0}, {0, 0, 102}, {255, 255, 255}, {10, 20, 30}};
};

inline std::string obj(bool with_colors) {
    const Pyramid pyramid;
    std::string text = "# a pyramid\n";
    for (int i = 0; i < 5; ++i) {
        text += "v";
        for (const double value : pyramid.positions[i]) {
            text += fmt::format(" {:f}", value);
        }
        for (int k = 0; with_colors && k < 3; ++k) {
            text += fmt::format(" {:.17g}", pyramid.colors[i][k] / 255.0);
        }
        text += "\n";
    }
    for (const auto& triangle : pyramid.triangles) {
        text += "f";
        for (const uint32_t corner : triangle) {
            text += fmt::format(" {}", corner + 1);
        }
        text += "\n";
    }
    return text;
}

/// Appends the bytes of `value`, the lowest or the highest first.
template <class T>
void append(std::string& bytes, T value, bool big_endian) {
    std::string raw(reinterpret_cast<const char*>(&value), sizeof value);
    if ((std::endian::native == std::endian::big) != big_endian) {
        raw.assign(raw.rbegin(), raw.rend());
    }
    bytes += raw;
}

inline std::string ply_header(const std::string& format, bool with_colors) {
    return fmt::format(
        "ply\nformat {} 1.0\ncomment a pyramid\nelement vertex 5\nproperty float x\n"
        "property double y\nproperty float z\n{}element face 6\n"
        "property list uchar int vertex_indices\nend_header\n",
        format,
        with_colors ? "property uchar red\nproperty uchar green\nproperty uchar blue\n" : "");
}

inline std::string ply_ascii(bool with_colors) {
    const Pyramid pyramid;
    std::string text = ply_header("ascii", with_colors);
    for (int i = 0; i < 5; ++i) {
        for (const double value : pyramid.positions[i]) {
            text += fmt::format("{:f} ", value);
        }
        for (int k = 0; with_colors && k < 3; ++k) {
            text += fmt::format("{} ", pyramid.colors[i][k]);
        }
        text += "\n";
    }
    for (const auto& triangle : pyramid.triangles) {
        text += "3";
        for (const uint32_t corner : triangle) {
            text += fmt::format(" {}", corner);
        }
        text += "\n";
    }
    return text;
}

inline std::string ply_binary(bool big_endian, bool with_colors) {
    const Pyramid pyramid;
    std::string bytes =
        ply_header(big_endian ? "binary_big_endian" : "binary_little_endian", with_colors);
    for (int i = 0; i < 5; ++i) {
        append(bytes, static_cast<float>(pyramid.positions[i][0]), big_endian);
        append(bytes, pyramid.positions[i][1], big_endian);
        append(bytes, static_cast<float>(pyramid.positions[i][2]), big_endian);
        for (int k = 0; with_colors && k < 3; ++k) {
            append(bytes, static_cast<uint8_t>(pyramid.colors[i][k]), big_endian);
        }
    }
    for (const auto& triangle : pyramid.triangles) {
        append(bytes, uint8_t{3}, big_endian);
        for (const uint32_t corner : triangle) {
            append(bytes, static_cast<int32_t>(corner), big_endian);
        }
    }
    return bytes;
}

inline std::string stl_ascii() {
    const Pyramid pyramid;
    std::string text = "solid a pyramid\n";
    for (const auto& triangle : pyramid.triangles) {
        text += " facet normal 0 0 nan\n  outer loop\n";
        for (const uint32_t corner : triangle) {
            text += "   vertex";
            for (const double value : pyramid.positions[corner]) {
                text += fmt::format(" {:f}", value);
            }
            text += "\n";
        }
        text += "  endloop\n endfacet\n";
    }
    return text + "endsolid a pyramid\n";
}

/// Binary STL whose header begins with `title`.
inline std::string stl_binary(const std::string& title) {
    const Pyramid pyramid;
    std::string bytes = title;
    bytes.resize(80, '\0');
    append(bytes, uint32_t{6}, false);
    for (const auto& triangle : pyramid.triangles) {
        for (int i = 0; i < 3; ++i) {
            append(bytes, 0.0f, false);
        }
        for (const uint32_t corner : triangle) {
            for (const double value : pyramid.positions[corner]) {
                append(bytes, static_cast<float>(value), false);
            }
        }
        append(bytes, uint16_t{0}, false);
    }
    return bytes;
}

/// A sample as a file: its content, and a name with its extension.
struct Sample {
    std::string name;
    std::string bytes;
};

inline std::vector<Sample> all(bool with_colors) {
    return {{"pyramid.obj", obj(with_colors)},
            {"ascii.ply", ply_ascii(with_colors)},
            {"little.ply", ply_binary(false, with_colors)},
            {"big.ply", ply_binary(true, with_colors)},
            {"ascii.stl", stl_ascii()},
            {"binary.stl", stl_binary("made by a test")},
            {"solid.stl", stl_binary("solid but binary")}};
}

}  // namespace voxelume::samples
