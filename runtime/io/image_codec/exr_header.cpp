// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image_codec/exr_header.hpp"

#include <fmt/format.h>

#include <algorithm>
#include <set>
#include <string_view>

#include "runtime/image/image.hpp"

namespace voxelume {
namespace {

const char* type_name(exr_pixel_type_t type) {
    return type == EXR_PIXEL_HALF ? "half" : type == EXR_PIXEL_FLOAT ? "float" : "uint";
}

const char* layout_name(exr_storage_t storage) {
    constexpr const char* kNames[] = {"scanline", "tiled", "deep scanline", "deep tiled"};
    return kNames[storage];
}

const char* compression_name(exr_compression_t compression) {
    constexpr const char* kNames[] = {"none",  "RLE", "ZIPS", "ZIP",  "PIZ",
                                      "PXR24", "B44", "B44A", "DWAA", "DWAB"};
    return kNames[compression];
}

bool is_flat(exr_storage_t storage) {
    return storage == EXR_STORAGE_SCANLINE || storage == EXR_STORAGE_TILED;
}

/// Reads a part of the file, or less at its end, for OpenEXR. Returns -1 if that fails.
int64_t read_at(exr_const_context_t, void* user_data, void* data, uint64_t size, uint64_t position,
                exr_stream_error_func_ptr_t) try {
    const auto& file = *static_cast<const InputFile*>(user_data);
    const uint64_t left = file.size() - std::min(position, file.size());
    const auto count = size_t(std::min(size, left));
    file.read(position, data, count);
    return int64_t(count);
} catch (const Error&) {
    return -1;
}

bool equal(const exr_attr_box2i_t& a, const exr_attr_box2i_t& b) {
    return a.min.x == b.min.x && a.min.y == b.min.y && a.max.x == b.max.x && a.max.y == b.max.y;
}

}  // namespace

bool is_of_format(std::string_view attribute, bool has_parts) {
    return attribute == "type" || (has_parts && attribute == "name");
}

ExrHeaderReader::ExrHeaderReader(const InputFile& file) : file_(file) {
    exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
    settings.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
    settings.user_data = const_cast<InputFile*>(&file);
    settings.read_fn = read_at;
    settings.size_fn = [](exr_const_context_t, void* of) {
        return int64_t(static_cast<const InputFile*>(of)->size());
    };
    check(exr_start_read(&context_, file.path().c_str(), &settings));
}

void ExrHeaderReader::check(exr_result_t result) const {
    if (result != EXR_ERR_SUCCESS)
        file_.refuse(
            fmt::format("not a readable OpenEXR file: {}", exr_get_default_error_message(result)));
}

int ExrHeaderReader::part_count() const {
    int count = 0;
    check(exr_get_count(context_, &count));
    return count;
}

exr_attr_box2i_t ExrHeaderReader::window(int part) const {
    exr_attr_box2i_t box{};
    check(exr_get_data_window(context_, part, &box));
    return box;
}

exr_storage_t ExrHeaderReader::storage(int part) const {
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    check(exr_get_storage(context_, part, &storage));
    return storage;
}

std::string ExrHeaderReader::part_name(int part) const {
    const char* name = nullptr;
    const exr_result_t result = exr_get_name(context_, part, &name);
    return result == EXR_ERR_SUCCESS && name ? name : "";
}

const exr_attr_chlist_t& ExrHeaderReader::list(int part) const {
    const exr_attr_chlist_t* channels = nullptr;
    check(exr_get_channels(context_, part, &channels));
    return *channels;
}

/// True if a part is read. The first part always is, so that errors are reported for it.
bool ExrHeaderReader::is_read(int part) const {
    return part == 0 || (is_flat(storage(part)) && equal(window(part), window(0)));
}

std::vector<ExrChannel> ExrHeaderReader::channels() const {
    std::vector<ExrChannel> channels;
    std::set<std::string> names;
    for (int part = 0; part < part_count(); ++part) {
        if (!is_read(part)) continue;
        const exr_attr_chlist_t& list = this->list(part);
        for (int i = 0; i < list.num_channels; ++i) {
            const exr_attr_chlist_entry_t& entry = list.entries[i];
            ExrChannel channel{part, entry.name.str, entry.name.str, entry.pixel_type};
            if (names.contains(channel.name)) channel.name = part_name(part) + "." + channel.own;
            if (!names.insert(channel.name).second)
                file_.refuse(fmt::format("two of its channels are {}", channel.name));
            channels.push_back(std::move(channel));
        }
    }
    return channels;
}

ExrHeader ExrHeaderReader::read() const {
    ExrHeader header;
    const exr_attr_box2i_t box = window(0);
    const int64_t width = int64_t{box.max.x} - box.min.x + 1;
    const int64_t height = int64_t{box.max.y} - box.min.y + 1;
    if (width <= 0 || height <= 0 || width > INT32_MAX || height > INT32_MAX)
        file_.refuse("has no pixels");
    header.width = static_cast<int>(width);
    header.height = static_cast<int>(height);
    header.layout = layout_name(storage(0));
    exr_compression_t compression = EXR_COMPRESSION_NONE;
    check(exr_get_compression(context_, 0, &compression));
    header.compression = compression_name(compression);
    for (const ExrChannel& channel : channels())
        header.channels[channel.name] = type_name(channel.type);
    const int parts = part_count();
    for (int part = 0; part < parts; ++part) {
        if (is_read(part)) add_attributes(part, header);
        if (parts == 1) continue;
        ExrPartHeader own{part_name(part), {}, is_read(part)};
        for (int i = 0; i < list(part).num_channels; ++i)
            own.channels.emplace_back(list(part).entries[i].name.str);
        header.parts.push_back(std::move(own));
    }
    return header;
}

void ExrHeaderReader::check_chunks() const {
    uint64_t chunks = 0;
    for (int part = 0; part < part_count(); ++part) {
        int32_t count = 0;
        check(exr_get_chunk_count(context_, part, &count));
        chunks += uint64_t(std::max(count, 0));
    }
    if (chunks > file_.size() / sizeof(uint64_t))
        file_.refuse(fmt::format(
            "not a readable OpenEXR file: it declares {} chunks and is far too small for them",
            chunks));
}

/// Adds a part's attributes, except those that an earlier part has.
void ExrHeaderReader::add_attributes(int part, ExrHeader& header) const {
    int32_t count = 0;
    check(exr_get_attribute_count(context_, part, &count));
    for (int32_t i = 0; i < count; ++i) {
        const exr_attribute_t* attribute = nullptr;
        check(exr_get_attribute_by_index(context_, part, EXR_ATTR_LIST_FILE_ORDER, i, &attribute));
        if (attribute->type == EXR_ATTR_STRING) {
            if (!is_of_format(attribute->name, part_count() > 1))
                header.attributes.emplace(attribute->name, attribute->string->str);
        } else if (attribute->type == EXR_ATTR_FLOAT &&
                   std::string_view(attribute->name) == kPixelAspect && attribute->f != 1) {
            header.attributes.emplace(attribute->name, fmt::format("{}", attribute->f));
        } else if (attribute->type == EXR_ATTR_CHROMATICITIES) {
            const exr_attr_chromaticities_t& c = *attribute->chromaticities;
            header.attributes.emplace(
                attribute->name,
                fmt::format("red {:g} {:g}, green {:g} {:g}, blue {:g} {:g}, white {:g} {:g}",
                            c.red_x, c.red_y, c.green_x, c.green_y, c.blue_x, c.blue_y, c.white_x,
                            c.white_y));
        }
    }
}

}  // namespace voxelume
