// SPDX-License-Identifier: Apache-2.0
// Voxelized model -> .vxm
#include <xxhash.h>
#include <zstd.h>

#include <memory>

#include "runtime/base/files/atomic_file.hpp"
#include "runtime/io/voxels/model_file.hpp"
#include "runtime/io/voxels/model_format.hpp"

namespace voxelume {

namespace {

// Level 1 is as fast as the disk. Models are read far more often than they are sent anywhere.
constexpr int kCompressionLevel = 1;

/// Builds the directory's bytes.
class DirectoryWriter {
  public:
    template <class Number>
    void put(Number number) {
        const char* bytes = reinterpret_cast<const char*>(&number);
        bytes_.append(bytes, sizeof number);
    }
    void put_text(const std::string& text) {
        put(static_cast<uint32_t>(text.size()));
        bytes_ += text;
    }
    const std::string& bytes() const { return bytes_; }

  private:
    std::string bytes_;
};

struct CompressedArray {
    ModelArraySummary summary;
    std::vector<char> bytes;
};

CompressedArray compress(AtomicFile& file, const ModelArray& array) {
    return std::visit(
        [&](const auto& elements) {
            CompressedArray result;
            const size_t size = elements.size() * sizeof(elements[0]);
            result.summary.type = static_cast<ElementType>(array.index());
            result.summary.count = elements.size();
            result.summary.checksum = XXH3_64bits(elements.data(), size);
            result.bytes.resize(ZSTD_compressBound(size));
            const size_t compressed = ZSTD_compress(result.bytes.data(), result.bytes.size(),
                                                    elements.data(), size, kCompressionLevel);
            if (ZSTD_isError(compressed)) file.fail(ZSTD_getErrorName(compressed));
            result.bytes.resize(compressed);
            result.bytes.shrink_to_fit();
            result.summary.compressed_bytes = compressed;
            return result;
        },
        array);
}

std::string write_directory(const ModelFile& model,
                            const std::map<std::string, CompressedArray>& arrays) {
    DirectoryWriter directory;
    for (const auto& [key, value] : model.header) {
        directory.put_text(key);
        directory.put_text(value);
    }
    for (const auto& [name, array] : arrays) {
        directory.put_text(name);
        directory.put(static_cast<uint32_t>(array.summary.type));
        directory.put(array.summary.count);
        directory.put(array.summary.offset);
        directory.put(array.summary.compressed_bytes);
        directory.put(array.summary.checksum);
    }
    return directory.bytes();
}

uint64_t checksum_of(const model_format::Start& start, const std::string& directory) {
    std::string checked(reinterpret_cast<const char*>(&start), model_format::kCheckedBytes);
    checked += directory;
    return XXH3_64bits(checked.data(), checked.size());
}

/// Start::data_sum of arrays that are written in this order.
uint32_t data_sum_of(const std::map<std::string, CompressedArray>& arrays) {
    const std::unique_ptr<XXH3_state_t, decltype(&XXH3_freeState)> state(XXH3_createState(),
                                                                         XXH3_freeState);
    XXH3_64bits_reset(state.get());
    for (const auto& [name, array] : arrays)
        XXH3_64bits_update(state.get(), array.bytes.data(), array.bytes.size());
    return model_format::data_sum_of(XXH3_64bits_digest(state.get()));
}

}  // namespace

void write_model_file(const std::filesystem::path& path, const ModelFile& model) {
    AtomicFile file(path);
    std::map<std::string, CompressedArray> arrays;
    for (const auto& [name, array] : model.arrays) arrays[name] = compress(file, array);

    model_format::Start start;
    start.header_entries = static_cast<uint32_t>(model.header.size());
    start.arrays = static_cast<uint32_t>(arrays.size());
    start.data_sum = data_sum_of(arrays);
    start.directory_bytes = write_directory(model, arrays).size();
    uint64_t offset = sizeof start + start.directory_bytes;
    for (auto& [name, array] : arrays) {
        array.summary.offset = offset;
        offset += array.bytes.size();
    }
    const std::string directory = write_directory(model, arrays);
    start.checksum = checksum_of(start, directory);

    file.write(&start, sizeof start);
    file.write(directory.data(), directory.size());
    for (const auto& [name, array] : arrays) file.write(array.bytes.data(), array.bytes.size());
    file.commit();
}

}  // namespace voxelume
