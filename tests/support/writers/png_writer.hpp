// SPDX-License-Identifier: Apache-2.0
// Writes PNG files for tests, without the program's own code.
#pragma once

#include <gtest/gtest.h>
#include <zlib.h>

#include <cstdint>
#include <string>
#include <vector>

namespace voxelume {

inline std::string big_endian(uint32_t value) {
    return {char(value >> 24), char(value >> 16), char(value >> 8), char(value)};
}

inline std::string png_chunk(const std::string& name, const std::string& data) {
    const std::string body = name + data;
    const auto sum = crc32(0, reinterpret_cast<const Bytef*>(body.data()), uInt(body.size()));
    return big_endian(uint32_t(data.size())) + body + big_endian(uint32_t(sum));
}

/// A PNG with these rows of bytes. `color`: 0 grey, 2 RGB, 6 RGBA.
inline std::string png_of_rows(int width, int bits, int color,
                               const std::vector<std::string>& rows) {
    std::string raw;
    for (const std::string& row : rows) raw += '\0' + row;
    std::string packed(compressBound(uLong(raw.size())), '\0');
    uLongf size = uLongf(packed.size());
    EXPECT_EQ(compress2(reinterpret_cast<Bytef*>(packed.data()), &size,
                        reinterpret_cast<const Bytef*>(raw.data()), uLong(raw.size()), 9),
              Z_OK);
    packed.resize(size);
    const std::string header = big_endian(uint32_t(width)) + big_endian(uint32_t(rows.size())) +
                               std::string{char(bits), char(color), 0, 0, 0};
    return "\x89PNG\r\n\x1a\n" + png_chunk("IHDR", header) + png_chunk("IDAT", packed) +
           png_chunk("IEND", "");
}

}  // namespace voxelume
