// SPDX-License-Identifier: Apache-2.0
// A dense array of values in a file (.npy, NRRD, NIfTI), as its header describes it.
#pragma once

#include <array>
#include <cstdint>
#include <filesystem>
#include <glm/mat4x4.hpp>
#include <glm/vec3.hpp>
#include <string>
#include <string_view>
#include <vector>

namespace voxelume {

class InputFile;

enum class CellType : uint8_t { boolean, u8, i8, u16, i16, u32, i32, u64, i64, f32, f64, f16 };

/// Bytes of a value in a file.
size_t bytes_of(CellType type);
/// Bytes of a value in memory, where float16 is float32.
size_t bytes_in_memory(CellType type);
std::string_view name_of(CellType type);
bool is_float(CellType type);

/// The encoding of values; `text` is numbers as words.
enum class DataEncoding : uint8_t { raw, gzip, bzip2, text };

/// The array's values, and where its cells lie. Axes of the file are numbered from the one whose
/// neighbours are closest in the file; axes of the model are x, y and z with Y up.
struct CellArray {
    std::filesystem::path data;    ///< the file that has the values
    std::filesystem::path header;  ///< header of a pair, if either may be named; else empty
    /// PNG slices along the file's last axis, of which `data` is the first; empty for other files.
    std::vector<std::filesystem::path> slices;
    uint64_t start = 0;  ///< byte of the first value, or of the compressed data
    DataEncoding encoding = DataEncoding::raw;
    uint64_t skip = 0;        ///< bytes after `start`, and after decompression, before the values
    bool is_swapped = false;  ///< the byte order is not this machine's
    CellType type = CellType::u8;
    int channels = 1;        ///< 1: values; 3 or 4: colours, the fourth is opacity
    bool is_planar = false;  ///< each channel is a plane; otherwise channels are interleaved
    glm::ivec3 counts{0};    ///< cells along the file's axes
    double slope = 1, intercept = 0;  ///< the stored number means slope * value + intercept

    glm::ivec3 axis{0, 1, 2};        ///< the file's axis along each of the model's
    glm::ivec3 sign{1, 1, 1};        ///< -1 where the two axes have opposite directions
    glm::dvec3 voxel_edge{1};        ///< metres along the model's axes
    glm::dvec3 first_corner{0};      ///< the model's smallest corner, metres
    std::string orientation;         ///< in words, for people
    std::vector<std::string> notes;  ///< notes on assumptions, and on unshown content

    bool is_compressed() const {
        return encoding == DataEncoding::gzip || encoding == DataEncoding::bzip2;
    }
    uint64_t cells() const { return uint64_t(counts.x) * uint64_t(counts.y) * uint64_t(counts.z); }
    uint64_t bytes() const { return cells() * uint64_t(channels) * bytes_of(type); }
    bool is_color() const { return channels > 1; }
    /// Cells along the model's axes.
    glm::ivec3 size() const { return {counts[axis.x], counts[axis.y], counts[axis.z]}; }
};

/// Sets the position of the cells from the map from a cell's indices along the file's axes to its
/// middle, in metres with Y up. Directions are rounded to the nearest axes, and a note tells the
/// angle if they are turned. Throws Error::input for directions that span no volume.
void set_place(const glm::dmat4& model_from_index, const InputFile& file, CellArray& array);

/// Throws Error::input for an array that has no cells or is too large for a model, and for a file
/// too small for its values. Called before memory is allocated.
void check_array(const CellArray& array, const InputFile& data);

}  // namespace voxelume
