// SPDX-License-Identifier: Apache-2.0
// .vxm -> voxelized model
#include <xxhash.h>
#include <zstd.h>

#include <cstring>

#include "runtime/base/files/file_hash.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/io/voxels/model_format.hpp"

namespace voxelume {

namespace {

/// The maximum of content bytes per byte of a zstd frame: a zstd block of 128 KiB takes at least
/// four bytes.
constexpr uint64_t kLargestRatio = 32768;

/// Parses the directory. Its checksum has been verified, but its writer may have stored wrong
/// values.
class DirectoryReader {
  public:
    DirectoryReader(const InputFile& file, std::string bytes)
        : file_(file), bytes_(std::move(bytes)) {}

    template <class Number>
    Number take() {
        Number number;
        std::memcpy(&number, take_bytes(sizeof number), sizeof number);
        return number;
    }
    std::string take_text() {
        const auto length = take<uint32_t>();
        return std::string(take_bytes(length), length);
    }
    bool at_end() const { return position_ == bytes_.size(); }

  private:
    const char* take_bytes(size_t count) {
        if (count > bytes_.size() - position_) file_.refuse("its directory is damaged");
        position_ += count;
        return bytes_.data() + position_ - count;
    }

    const InputFile& file_;
    std::string bytes_;
    size_t position_ = 0;
};

model_format::Start read_start(const InputFile& file) {
    model_format::Start start;
    const auto magic = start.magic;
    if (file.size() < sizeof start) file.refuse("too short for a voxelume model");
    file.read(0, &start, sizeof start);
    if (start.magic != magic) file.refuse("not a voxelume model");
    if (start.version != 1)
        file.refuse(
            fmt::format("a model of version {}, and this voxelume reads version 1; "
                        "voxelize it again or update voxelume",
                        start.version));
    return start;
}

std::string read_directory(const InputFile& file, const model_format::Start& start) {
    const uint64_t minimum = start.header_entries * uint64_t{model_format::kSmallestHeaderEntry} +
                             start.arrays * uint64_t{model_format::kSmallestArrayEntry};
    if (start.directory_bytes > file.size() - sizeof start)
        file.refuse("the file ends within its directory; it is truncated");
    if (minimum > start.directory_bytes) file.refuse("its directory is damaged");
    std::string checked(model_format::kCheckedBytes + start.directory_bytes, '\0');
    std::memcpy(checked.data(), &start, model_format::kCheckedBytes);
    file.read(sizeof start, checked.data() + model_format::kCheckedBytes, start.directory_bytes);
    if (XXH3_64bits(checked.data(), checked.size()) != start.checksum)
        file.refuse("its directory is damaged: the checksum differs");
    return checked.substr(model_format::kCheckedBytes);
}

ModelArraySummary take_array(const InputFile& file, const std::string& name,
                             DirectoryReader& directory) {
    const auto type = directory.take<uint32_t>();
    if (type > static_cast<uint32_t>(ElementType::f32))
        file.refuse(fmt::format("array {} has an unknown type", name));
    ModelArraySummary array;
    array.type = static_cast<ElementType>(type);
    array.count = directory.take<uint64_t>();
    array.offset = directory.take<uint64_t>();
    array.compressed_bytes = directory.take<uint64_t>();
    array.checksum = directory.take<uint64_t>();
    if (array.offset > file.size() || array.compressed_bytes > file.size() - array.offset)
        file.refuse(fmt::format("the file ends within array {}; it is truncated", name));
    if (array.count > array.compressed_bytes * kLargestRatio / element_bytes(array.type))
        file.refuse(fmt::format("array {} declares more elements than it can hold", name));
    return array;
}

ModelSummary read_summary(const InputFile& file) {
    const model_format::Start start = read_start(file);
    DirectoryReader directory(file, read_directory(file, start));
    ModelSummary summary;
    for (uint32_t i = 0; i < start.header_entries; ++i) {
        const std::string key = directory.take_text();
        summary.header[key] = directory.take_text();
    }
    for (uint32_t i = 0; i < start.arrays; ++i) {
        const std::string name = directory.take_text();
        summary.arrays[name] = take_array(file, name, directory);
    }
    if (!directory.at_end()) file.refuse("its directory is damaged");
    return summary;
}

template <class Element>
std::vector<Element> read_elements(const InputFile& file, const std::string& name,
                                   const ModelArraySummary& array) {
    std::vector<char> compressed(array.compressed_bytes);
    file.read(array.offset, compressed.data(), compressed.size());
    const uint64_t size = array.count * sizeof(Element);
    const auto damaged = [&] { file.refuse(fmt::format("array {} is damaged", name)); };
    if (ZSTD_getFrameContentSize(compressed.data(), compressed.size()) != size) damaged();
    std::vector<Element> elements(array.count);
    const size_t got = ZSTD_decompress(elements.data(), size, compressed.data(), compressed.size());
    if (ZSTD_isError(got) || got != size) damaged();
    if (XXH3_64bits(elements.data(), size) != array.checksum) damaged();
    return elements;
}

ModelArray read_array(const InputFile& file, const std::string& name,
                      const ModelArraySummary& array) {
    switch (array.type) {
        case ElementType::u8:
            return read_elements<uint8_t>(file, name, array);
        case ElementType::i16:
            return read_elements<int16_t>(file, name, array);
        case ElementType::u32:
            return read_elements<uint32_t>(file, name, array);
        case ElementType::u64:
            return read_elements<uint64_t>(file, name, array);
        case ElementType::f32:
            break;
    }
    return read_elements<float>(file, name, array);
}

}  // namespace

const char* element_name(ElementType type) {
    constexpr const char* kNames[] = {"u8", "i16", "u32", "u64", "f32"};
    return kNames[static_cast<size_t>(type)];
}

size_t element_bytes(ElementType type) {
    constexpr size_t kBytes[] = {1, 2, 4, 8, 4};
    return kBytes[static_cast<size_t>(type)];
}

ModelSummary read_model_summary(const std::filesystem::path& path) {
    return read_summary(InputFile(path));
}

ModelFile read_model_file(const std::filesystem::path& path) {
    const InputFile file(path);
    const ModelSummary summary = read_summary(file);
    ModelFile model;
    model.header = summary.header;
    for (const auto& [name, array] : summary.arrays)
        model.arrays[name] = read_array(file, name, array);
    return model;
}

bool is_model_as_written(const std::filesystem::path& path) {
    const InputFile file(path);
    try {
        read_model_file(path);
        const model_format::Start start = read_start(file);
        const uint64_t data = sizeof start + start.directory_bytes;
        return start.data_sum == 0 || start.data_sum == model_format::data_sum_of(hash_of_bytes(
                                                            file, data, file.size() - data));
    } catch (const Error& error) {
        if (error.kind() != ErrorKind::input) throw;
        return false;
    }
}

}  // namespace voxelume
