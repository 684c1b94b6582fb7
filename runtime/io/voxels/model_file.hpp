// SPDX-License-Identifier: Apache-2.0
// Voxelized models on disk (.vxm): named arrays with checksums and a header of text.
//
// The file is little-endian, in this order:
//    0  8 bytes  89 56 58 4d 0d 0a 1a 0a: reveals a transfer that rewrote line ends, as in PNG
//    8  u32      version of the container, 1
//   12  u32      number of header entries
//   16  u32      number of arrays
//   20  u32      low bits of the xxh3 of all bytes behind the directory; 0 in older files
//   24  u64      bytes of the directory
//   32  u64      xxh3 of bytes 0-31 and of the directory
//   40           directory. Each header entry: u32 length and bytes of its key, then of its value.
//                Each array: u32 length and bytes of its name, u32 element type (ElementType), u64
//                elements, u64 offset in the file, u64 compressed bytes, u64 xxh3 of the elements.
//   then the arrays in the order of their names, each one zstd frame.
// The writer decides what the header and the arrays mean; `format` in the header names it.
#pragma once

#include <cstdint>
#include <filesystem>
#include <map>
#include <string>
#include <variant>
#include <vector>

namespace voxelume {

/// The elements of an array. The alternatives are in the order of ElementType.
using ModelArray = std::variant<std::vector<uint8_t>, std::vector<int16_t>, std::vector<uint32_t>,
                                std::vector<uint64_t>, std::vector<float>>;

enum class ElementType : uint32_t { u8, i16, u32, u64, f32 };

struct ModelFile {
    std::map<std::string, std::string> header;
    std::map<std::string, ModelArray> arrays;
};

/// Writes the file whole or not at all. Equal content gives equal bytes. Throws Error::output.
void write_model_file(const std::filesystem::path& path, const ModelFile& model);

/// Reads and verifies everything. Sizes are checked against the file before memory is allocated.
/// Throws Error::input for a file that is missing, damaged, truncated or of a later version.
ModelFile read_model_file(const std::filesystem::path& path);

/// Reads everything, and the bytes that mean nothing, too. False where some aren't those that were
/// written; in files that tell nothing of the latter, only the content counts. Throws Error::input
/// for a file that can't be opened.
bool is_model_as_written(const std::filesystem::path& path);

/// One array as the directory describes it.
struct ModelArraySummary {
    ElementType type = ElementType::u8;
    uint64_t count = 0;   ///< elements
    uint64_t offset = 0;  ///< bytes from the file's start
    uint64_t compressed_bytes = 0;
    uint64_t checksum = 0;  ///< xxh3 of the elements' bytes
};

struct ModelSummary {
    std::map<std::string, std::string> header;
    std::map<std::string, ModelArraySummary> arrays;
};

/// Reads the directory alone. Throws Error::input as read_model_file does.
ModelSummary read_model_summary(const std::filesystem::path& path);

/// The name of an element type: "u8", "i16", "u32", "u64" or "f32".
const char* element_name(ElementType type);
size_t element_bytes(ElementType type);

}  // namespace voxelume
