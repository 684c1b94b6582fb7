// SPDX-License-Identifier: Apache-2.0
// Bytes of a .vox chunk -> numbers, texts and dictionaries.
#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>

#include "runtime/base/files/input_file.hpp"

namespace voxelume {

/// Texts by their names.
using VoxDictionary = std::map<std::string, std::string, std::less<>>;

/// Takes values from the content of a chunk, one after the other. Throws Error::input where it
/// ends before them.
class VoxContent {
  public:
    VoxContent(const InputFile& file, std::string letters, std::string bytes)
        : file_(file), letters_(std::move(letters)), bytes_(std::move(bytes)) {}

    int32_t take_int();
    float take_float();
    std::string take_text();
    VoxDictionary take_dictionary();
    /// A count of things that take at least `bytes_each`.
    int32_t take_count(size_t bytes_each);
    const std::string& bytes() const { return bytes_; }
    [[noreturn]] void refuse(std::string_view reason) const;

  private:
    const char* take_bytes(size_t count);

    const InputFile& file_;
    std::string letters_;
    std::string bytes_;
    size_t position_ = 0;
};

/// A dictionary's text; `otherwise` where it has none.
std::string text_in(const VoxDictionary& dictionary, std::string_view name,
                    std::string_view otherwise = "");

/// A dictionary's number; `otherwise` where it has none, or no number.
float number_in(const VoxDictionary& dictionary, std::string_view name, float otherwise);

}  // namespace voxelume
