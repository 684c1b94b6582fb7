// SPDX-License-Identifier: Apache-2.0
// OpenEXR -> Image and header.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>
#include <openexr.h>

#include <algorithm>

#include "runtime/base/error.hpp"
#include "runtime/base/input_file.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/exr_header_check.hpp"

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

/// Owns a handle of OpenEXR's core library, which parses the header without allocating memory for
/// pixels or row tables.
class HeaderReader {
  public:
    explicit HeaderReader(const std::filesystem::path& path) : path_(path) {
        exr_context_initializer_t settings = EXR_DEFAULT_CONTEXT_INITIALIZER;
        settings.error_handler_fn = [](exr_const_context_t, exr_result_t, const char*) {};
        check(exr_start_read(&context_, path.c_str(), &settings));
    }
    ~HeaderReader() { exr_finish(&context_); }
    HeaderReader(const HeaderReader&) = delete;
    HeaderReader& operator=(const HeaderReader&) = delete;

    ExrHeader read() const;

    /// Refuses parts with more chunks than the file has room for in its table of them.
    void check_chunks(const InputFile& file) const;

  private:
    void check(exr_result_t result) const {
        if (result == EXR_ERR_SUCCESS) return;
        throw Error(ErrorKind::input, "{}: not a readable OpenEXR file: {}",
                    SourcePlace(path_.string()), exr_get_default_error_message(result));
    }
    void read_attributes(ExrHeader& header) const;

    std::filesystem::path path_;
    exr_context_t context_ = nullptr;
};

ExrHeader HeaderReader::read() const {
    ExrHeader header;
    exr_attr_box2i_t window;
    check(exr_get_data_window(context_, 0, &window));
    const int64_t width = int64_t{window.max.x} - window.min.x + 1;
    const int64_t height = int64_t{window.max.y} - window.min.y + 1;
    if (width <= 0 || height <= 0 || width > INT32_MAX || height > INT32_MAX)
        throw Error(ErrorKind::input, "{}: has no pixels", SourcePlace(path_.string()));
    header.width = static_cast<int>(width);
    header.height = static_cast<int>(height);
    exr_storage_t storage = EXR_STORAGE_SCANLINE;
    check(exr_get_storage(context_, 0, &storage));
    header.layout = layout_name(storage);
    exr_compression_t compression = EXR_COMPRESSION_NONE;
    check(exr_get_compression(context_, 0, &compression));
    header.compression = compression_name(compression);
    const exr_attr_chlist_t* channels = nullptr;
    check(exr_get_channels(context_, 0, &channels));
    for (int i = 0; i < channels->num_channels; ++i) {
        const exr_attr_chlist_entry_t& channel = channels->entries[i];
        header.channels[channel.name.str] = type_name(channel.pixel_type);
    }
    read_attributes(header);
    return header;
}

void HeaderReader::check_chunks(const InputFile& file) const {
    int parts = 0;
    check(exr_get_count(context_, &parts));
    uint64_t chunks = 0;
    for (int part = 0; part < parts; ++part) {
        int32_t count = 0;
        check(exr_get_chunk_count(context_, part, &count));
        chunks += uint64_t(std::max(count, 0));
    }
    if (chunks > file.size() / sizeof(uint64_t))
        file.refuse(fmt::format(
            "not a readable OpenEXR file: it declares {} chunks and is far too small for them",
            chunks));
}

void HeaderReader::read_attributes(ExrHeader& header) const {
    int32_t count = 0;
    check(exr_get_attribute_count(context_, 0, &count));
    for (int32_t i = 0; i < count; ++i) {
        const exr_attribute_t* attribute = nullptr;
        check(exr_get_attribute_by_index(context_, 0, EXR_ATTR_LIST_FILE_ORDER, i, &attribute));
        if (attribute->type == EXR_ATTR_STRING) {
            header.attributes[attribute->name] = attribute->string->str;
        } else if (attribute->type == EXR_ATTR_CHROMATICITIES) {
            const exr_attr_chromaticities_t& c = *attribute->chromaticities;
            header.attributes[attribute->name] = fmt::format(
                "red {:g} {:g}, green {:g} {:g}, blue {:g} {:g}, white {:g} {:g}", c.red_x, c.red_y,
                c.green_x, c.green_y, c.blue_x, c.blue_y, c.white_x, c.white_y);
        }
    }
}

/// The maximum of pixel bytes per file byte. No compression of OpenEXR reaches it, so a header
/// beyond it is false, and no memory is allocated for it.
constexpr uint64_t kLargestRatio = 4096;

void check_size(const InputFile& file, const ExrHeader& header) {
    if (header.layout.starts_with("deep"))
        file.refuse("is a deep image, and a flat one is needed here");
    const uint64_t pixels =
        static_cast<uint64_t>(header.width) * static_cast<uint64_t>(header.height);
    if (pixels / kLargestRatio * header.channels.size() > file.size())
        file.refuse(
            fmt::format("declares {} x {} pixels and is far too small for them; it is damaged",
                        header.width, header.height));
}

/// Allocates memory for every channel and points the frame buffer at it.
Imf::FrameBuffer attach_planes(const InputFile& file, const Imf::InputFile& input, Image& image) {
    Imf::FrameBuffer buffer;
    const Imath::Box2i window = input.header().dataWindow();
    const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    const Imf::ChannelList& channels = input.header().channels();
    for (auto channel = channels.begin(); channel != channels.end(); ++channel) {
        if (channel.channel().xSampling != 1 || channel.channel().ySampling != 1)
            file.refuse(fmt::format("channel {} is subsampled, which voxelume doesn't read",
                                    channel.name()));
        const bool is_id = channel.channel().type == Imf::UINT;
        void* plane = nullptr;
        if (is_id)
            plane = (image.id_planes[channel.name()] = std::vector<uint32_t>(pixels)).data();
        else
            plane = (image.planes[channel.name()] = std::vector<float>(pixels)).data();
        buffer.insert(channel.name(),
                      Imf::Slice::Make(is_id ? Imf::UINT : Imf::FLOAT, plane, window));
    }
    return buffer;
}

}  // namespace

ExrHeader read_exr_header(const std::filesystem::path& path) {
    const InputFile file(path);  // reports what is wrong with the file itself
    check_exr_header(file);
    return HeaderReader(path).read();
}

Image read_exr(const std::filesystem::path& path) {
    const InputFile file(path);
    check_exr_header(file);
    const HeaderReader reader(path);
    const ExrHeader header = reader.read();
    check_size(file, header);
    reader.check_chunks(file);
    try {
        Imf::InputFile input(path.c_str());
        if (!input.isComplete()) file.refuse("rows are missing; the file is truncated");
        Image image;
        image.width = header.width;
        image.height = header.height;
        input.setFrameBuffer(attach_planes(file, input, image));
        const Imath::Box2i window = input.header().dataWindow();
        input.readPixels(window.min.y, window.max.y);
        const Imath::Box2i display = input.header().displayWindow();
        if (window != display && window.min.x >= display.min.x && window.max.x <= display.max.x &&
            window.min.y >= display.min.y && window.max.y <= display.max.y) {
            const Imath::V2i first = window.min - display.min, size = display.size();
            image.first = {first.x, first.y};
            image.frame = {size.x + 1, size.y + 1};
        }
        for (auto a = input.header().begin(); a != input.header().end(); ++a)
            // "type" belongs to the file format: it says that a part consists of scanlines or of
            // tiles.
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
                text && a.name() != std::string_view("type"))
                image.attributes[a.name()] = text->value();
        return image;
    } catch (const Iex::BaseExc& error) {
        file.refuse(fmt::format("not a readable OpenEXR file: {}", error.what()));
    }
}

}  // namespace voxelume
