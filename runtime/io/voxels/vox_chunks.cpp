// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/voxels/vox_chunks.hpp"

#include <cmath>
#include <cstdlib>
#include <cstring>

namespace voxelume {

const char* VoxContent::take_bytes(size_t count) {
    if (count > bytes_.size() - position_) refuse("ends before its values do");
    position_ += count;
    return bytes_.data() + position_ - count;
}

int32_t VoxContent::take_int() {
    int32_t value = 0;
    std::memcpy(&value, take_bytes(sizeof value), sizeof value);
    return value;
}

float VoxContent::take_float() {
    float value = 0;
    std::memcpy(&value, take_bytes(sizeof value), sizeof value);
    return value;
}

int32_t VoxContent::take_count(size_t bytes_each) {
    const int32_t count = take_int();
    if (count < 0 || size_t(count) > (bytes_.size() - position_) / bytes_each)
        refuse("counts more than it holds");
    return count;
}

std::string VoxContent::take_text() {
    const int32_t size = take_count(1);
    return std::string(take_bytes(size_t(size)), size_t(size));
}

VoxDictionary VoxContent::take_dictionary() {
    VoxDictionary dictionary;
    for (int32_t left = take_count(8); left > 0; --left) {
        std::string name = take_text();
        dictionary[std::move(name)] = take_text();
    }
    return dictionary;
}

void VoxContent::refuse(std::string_view reason) const {
    file_.refuse(fmt::format("a chunk {} {}", letters_, reason));
}

std::string text_in(const VoxDictionary& dictionary, std::string_view name,
                    std::string_view otherwise) {
    const auto found = dictionary.find(name);
    return found == dictionary.end() ? std::string(otherwise) : found->second;
}

float number_in(const VoxDictionary& dictionary, std::string_view name, float otherwise) {
    const auto found = dictionary.find(name);
    if (found == dictionary.end()) return otherwise;
    char* end = nullptr;
    const float value = std::strtof(found->second.c_str(), &end);
    return end == found->second.c_str() || !std::isfinite(value) ? otherwise : value;
}

}  // namespace voxelume
