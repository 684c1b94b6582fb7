// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/gltf/gltf_accessor.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <array>
#include <bit>
#include <cmath>
#include <cstring>
#include <string_view>

#include "runtime/base/huge_pages.hpp"

namespace voxelume {
namespace {

enum ComponentType : uint64_t {
    kByte = 5120,
    kUnsignedByte,
    kShort,
    kUnsignedShort,
    kUnsignedInt = 5125,
    kFloat
};

size_t size_of(uint64_t type) {
    return type <= kUnsignedByte ? 1 : type <= kUnsignedShort ? 2 : 4;
}

struct ElementType {
    std::string_view name;
    int components, rows;  ///< a matrix' columns begin at multiples of four bytes
};

constexpr std::array<ElementType, 7> kElements = {{{"SCALAR", 1, 1},
                                                   {"VEC2", 2, 2},
                                                   {"VEC3", 3, 3},
                                                   {"VEC4", 4, 4},
                                                   {"MAT2", 4, 2},
                                                   {"MAT3", 9, 3},
                                                   {"MAT4", 16, 4}}};

uint32_t load(const uint8_t* at, size_t bytes) {
    uint32_t word = 0;
    for (size_t i = 0; i < bytes; ++i) word |= uint32_t{at[i]} << 8 * i;
    return word;
}

/// The location of the elements of an accessor, or of its sparse part.
struct Elements {
    const uint8_t* first = nullptr;  ///< null: all are 0
    size_t stride = 0;
    uint64_t type = kFloat;
    bool is_normalized = false;
    int components = 1, rows = 1;

    size_t column_bytes() const {
        const size_t bytes = size_of(type) * size_t(rows);
        return components > rows ? (bytes + 3) / 4 * 4 : bytes;
    }
    size_t bytes() const {
        const size_t columns = size_t(components / rows);
        return column_bytes() * (columns - 1) + size_of(type) * size_t(rows);
    }
    uint32_t word(uint64_t element, int component) const {
        const size_t column = size_t(component / rows), row = size_t(component % rows);
        return load(first + element * stride + column * column_bytes() + row * size_of(type),
                    size_of(type));
    }
    float value(uint64_t element, int component) const {
        if (!first) return 0;
        const uint32_t word = this->word(element, component);
        switch (type) {
            case kByte:
                return scaled(int8_t(word), 127);
            case kUnsignedByte:
                return scaled(int32_t(word), 255);
            case kShort:
                return scaled(int16_t(word), 32767);
            case kUnsignedShort:
                return scaled(int32_t(word), 65535);
            case kFloat:
                return std::bit_cast<float>(word);
            default:
                return float(word);
        }
    }

    /// True if elements of this type are adjacent words in this machine's byte order.
    bool are_words(uint64_t of_type) const {
        return std::endian::native == std::endian::little && first != nullptr && type == of_type &&
               components == rows && stride == sizeof(uint32_t) * size_t(components);
    }

  private:
    float scaled(int32_t integer, int32_t full) const {
        return is_normalized ? std::max(float(integer) / float(full), -1.0f) : float(integer);
    }
};

/// Takes the bytes of `count` elements from a buffer view. Throws where they don't lie in it.
void place(const GltfFile& file, const GltfValue& at, uint64_t count, Elements& elements) {
    if (!at.has("bufferView")) return;
    const std::span<const uint8_t> bytes = file.view(at, "bufferView");
    const uint64_t offset = at.count("byteOffset", 0);
    const GltfValue view = file.root().item("bufferViews", size_t(at.count("bufferView", 0)));
    const uint64_t min_stride = elements.bytes();
    elements.stride = view.count("byteStride", min_stride);
    if (elements.stride < min_stride || elements.stride > 4096)
        view.fail(fmt::format("elements of {} bytes, {} bytes apart", min_stride, elements.stride));
    const uint64_t needed = count == 0 ? 0 : (count - 1) * elements.stride + elements.bytes();
    if (offset > bytes.size() || needed > bytes.size() - offset)
        at.fail(fmt::format("{} elements from byte {} on don't fit into its {} bytes", count,
                            offset, bytes.size()));
    elements.first = bytes.data() + offset;
}

uint64_t count_of(const GltfValue& accessor) {
    const uint64_t count = accessor.count("count", 0);
    if (count == 0 || count >= kMaxGltfElements)
        accessor.fail(fmt::format("{} elements; it has at least 1 and fewer than 2^31", count));
    return count;
}

GltfValue accessor_of(const GltfFile& file, const GltfValue& from, const char* key) {
    const int number = from.index(key, file.root().size("accessors"));
    if (number < 0) from.fail(fmt::format("has no {}", key));
    return file.root().item("accessors", size_t(number));
}

/// Stores the values of a sparse accessor at their indices.
template <class Store>
void read_sparse(const GltfFile& file, const GltfValue& accessor, uint64_t count, Elements elements,
                 const Store& store) {
    if (!accessor.has("sparse")) return;
    const GltfValue sparse = accessor.at("sparse"), listed = sparse.at("indices");
    const uint64_t changed = sparse.count("count", 0);
    if (changed > count) sparse.fail(fmt::format("changes {} of {} elements", changed, count));
    Elements indices;
    indices.type = gltf_component_type(listed);
    if (indices.type == kFloat) listed.fail("indices are whole numbers");
    place(file, listed, changed, indices);
    elements.first = nullptr;
    place(file, sparse.at("values"), changed, elements);
    for (uint64_t i = 0; i < changed; ++i) {
        const uint32_t index = indices.first ? indices.word(i, 0) : 0;
        if (index >= count) listed.fail(fmt::format("names element {} of {}", index, count));
        store(index, elements, i);
    }
}

/// Takes the elements that a Draco primitive fills. False where there are none.
bool take_decoded(const GltfFile& file, const GltfValue& accessor, size_t number, uint64_t count,
                  Elements& elements) {
    const std::vector<uint8_t>* const decoded = file.decoded_accessor(number);
    if (!decoded) return false;
    elements.stride = size_of(elements.type) * size_t(elements.components);
    if (elements.rows != elements.components || decoded->size() / elements.stride < count)
        accessor.fail("its Draco data have another type than it");
    elements.first = decoded->data();
    return true;
}

}  // namespace

uint64_t gltf_component_type(const GltfValue& accessor) {
    const uint64_t type = accessor.count("componentType", 0);
    if (type < kByte || type > kFloat || type == kUnsignedShort + 1)
        accessor.fail(fmt::format("{} is no type of components", type));
    return type;
}

GltfValues gltf_values(const GltfFile& file, const GltfValue& from, const char* key,
                       std::initializer_list<int> components) {
    const GltfValue accessor = accessor_of(file, from, key);
    const auto* const kind =
        std::ranges::find(kElements, accessor.text("type"), &ElementType::name);
    if (kind == kElements.end() ||
        std::ranges::find(components, kind->components) == components.end())
        accessor.fail(fmt::format("isn't of the type that {} needs", key));
    Elements elements;
    elements.type = gltf_component_type(accessor);
    elements.is_normalized = accessor.boolean("normalized", false);
    elements.components = kind->components;
    elements.rows = kind->rows;
    GltfValues found;
    found.count = count_of(accessor);
    found.components = kind->components;
    if (!take_decoded(file, accessor, size_t(from.index(key, SIZE_MAX)), found.count, elements))
        place(file, accessor, found.count, elements);
    if (!elements.first && found.count > (uint64_t{1} << 24))
        accessor.fail("more than 2^24 elements without a buffer view");
    reserve_in_huge_pages(found.values, found.count * uint64_t(found.components));
    found.values.resize(found.count * uint64_t(found.components));
    const auto store = [&](uint64_t index, const Elements& of, uint64_t element) {
        for (int c = 0; c < found.components; ++c)
            found.values[index * uint64_t(found.components) + uint64_t(c)] = of.value(element, c);
    };
    if (elements.are_words(kFloat))
        std::memcpy(found.values.data(), elements.first, found.values.size() * sizeof(float));
    else
        for (uint64_t i = 0; i < found.count && elements.first; ++i) store(i, elements, i);
    read_sparse(file, accessor, found.count, elements, store);
    return found;
}

uint64_t count_gltf_values(const GltfFile& file, const GltfValue& from, const char* key) {
    return count_of(accessor_of(file, from, key));
}

std::vector<uint32_t> gltf_indices(const GltfFile& file, const GltfValue& from, const char* key,
                                   uint64_t limit) {
    const GltfValue accessor = accessor_of(file, from, key);
    Elements elements;
    elements.type = gltf_component_type(accessor);
    if (accessor.text("type") != "SCALAR" || elements.type == kFloat || elements.type == kByte ||
        elements.type == kShort)
        accessor.fail("indices are unsigned whole numbers");
    uint64_t count = count_of(accessor);
    const auto number = size_t(from.index(key, SIZE_MAX));
    if (const auto* const decoded = file.decoded_accessor(number)) {
        elements.type = kUnsignedInt;
        count = decoded->size() / 4;  // Draco makes more indices of a strip than its accessor has
        take_decoded(file, accessor, number, count, elements);
    } else {
        place(file, accessor, count, elements);
    }
    if (!elements.first && count > (uint64_t{1} << 24))
        accessor.fail("more than 2^24 elements without a buffer view");
    std::vector<uint32_t> indices;
    reserve_in_huge_pages(indices, count);
    indices.resize(count);
    const auto store = [&](uint64_t index, const Elements& of, uint64_t element) {
        const uint32_t value = of.first ? of.word(element, 0) : 0;
        if (value >= limit)
            accessor.fail(fmt::format("names vertex {}, and there are {}", value, limit));
        indices[index] = value;
    };
    const bool are_words = elements.are_words(kUnsignedInt);
    if (are_words) std::memcpy(indices.data(), elements.first, count * sizeof(uint32_t));
    if (!are_words || *std::ranges::max_element(indices) >= limit)
        for (uint64_t i = 0; i < count; ++i) store(i, elements, i);
    read_sparse(file, accessor, count, elements, store);
    return indices;
}

}  // namespace voxelume
