// SPDX-License-Identifier: Apache-2.0
// The header of a PLY file: the elements that follow it, and the properties of each.
#pragma once

#include "runtime/io/mesh/mesh_source.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace voxelume {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// The size of a value in a binary file, in bytes.
uint64_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
    return type < PlyType::float32;
}

struct PlyProperty {
    std::string name;
    PlyType type;  ///< the type of the value, or of each value of a list
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  ///< the type of a list's count; always an integer
};

struct PlyElement {
    std::string name;
    uint64_t count;
    std::vector<PlyProperty> properties;

    /// The minimum that one of these elements takes in the file: every list is empty and every
    /// ascii value has one digit.
    uint64_t min_bytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements;
    const char* body;     ///< the first byte after the header's last line
    std::string texture;  ///< name in the first comment TextureFile; empty without one
};

/// Parses the header. Throws Error::input with the line for a header that isn't PLY 1.0, and with
/// the element for one that promises more than the file has bytes for. So a caller may allocate
/// memory by the counts.
PlyHeader parse_ply_header(const MeshSource& source);

}  // namespace voxelume
