// The header of a PLY file: which elements follow, and of what properties each is made.
#pragma once

#include "runtime/io/mesh/mesh_source.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace voxelume {

enum class PlyFormat { ascii, binary_little_endian, binary_big_endian };

enum class PlyType { int8, uint8, int16, uint16, int32, uint32, float32, float64 };

/// Bytes of a value in a binary file.
uint64_t size_of(PlyType type);
inline bool is_integer(PlyType type) {
    return type < PlyType::float32;
}

struct PlyProperty {
    std::string name;
    PlyType type;  ///< of the value, or of each value of a list
    bool is_list = false;
    PlyType count_type = PlyType::uint8;  ///< of a list's count; always an integer
};

struct PlyElement {
    std::string name;
    uint64_t count;
    std::vector<PlyProperty> properties;

    /// The least that one of them takes in the file: every list empty, every ascii value one digit.
    uint64_t min_bytes(PlyFormat format) const;
};

struct PlyHeader {
    PlyFormat format;
    std::vector<PlyElement> elements;
    const char* body;  ///< the first byte behind the header's last line
};

/// Throws Error::input with the line for a header that isn't PLY 1.0, and with the element for one
/// that promises more than the file has bytes for, so that a count may be trusted with memory.
PlyHeader parse_ply_header(const MeshSource& source);

}  // namespace voxelume
