// SPDX-License-Identifier: Apache-2.0
// OpenEXR -> Image.
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include "runtime/base/error.hpp"
#include "runtime/base/files/input_file.hpp"
#include "runtime/base/main_memory.hpp"
#include "runtime/io/image/exr.hpp"
#include "runtime/io/image/exr_header.hpp"
#include "runtime/io/image/exr_header_check.hpp"

namespace voxelume {

namespace {

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

/// Reads the rows of a part into planes of the image, which it allocates.
void read_part(const InputFile& file, Imf::MultiPartInputFile& input, int number,
               const std::vector<ExrChannel>& channels, Image& image) {
    Imf::InputPart part(input, number);
    Imf::FrameBuffer buffer;
    const Imath::Box2i window = part.header().dataWindow();
    if (window.size() != Imath::V2i(image.width - 1, image.height - 1))
        file.refuse("not a readable OpenEXR file: its data windows differ");
    const size_t pixels = static_cast<size_t>(image.width) * static_cast<size_t>(image.height);
    for (const ExrChannel& channel : channels) {
        if (channel.part != number) continue;
        const Imf::Channel* found = part.header().channels().findChannel(channel.own);
        if (!found) file.refuse(fmt::format("channel {} is missing", channel.own));
        if (found->xSampling != 1 || found->ySampling != 1)
            file.refuse(
                fmt::format("channel {} is subsampled, which voxelume doesn't read", channel.name));
        const bool is_id = channel.type == EXR_PIXEL_UINT;
        void* plane = nullptr;
        if (is_id)
            plane = (image.id_planes[channel.name] = std::vector<uint32_t>(pixels)).data();
        else
            plane = (image.planes[channel.name] = std::vector<float>(pixels)).data();
        buffer.insert(channel.own, Imf::Slice::Make(is_id ? Imf::UINT : Imf::FLOAT, plane, window));
    }
    part.setFrameBuffer(buffer);
    part.readPixels(window.min.y, window.max.y);
}

/// Sets an image's position in the display window, where its data window is a part of that.
void set_place(const Imf::Header& header, Image& image) {
    const Imath::Box2i& window = header.dataWindow();
    const Imath::Box2i& display = header.displayWindow();
    if (window == display || window.min.x < display.min.x || window.max.x > display.max.x ||
        window.min.y < display.min.y || window.max.y > display.max.y)
        return;
    const Imath::V2i first = window.min - display.min, size = display.size();
    image.first = {first.x, first.y};
    image.frame = {size.x + 1, size.y + 1};
}

void add_texts(const Imf::Header& header, bool has_parts, Image& image) {
    if (const float aspect = header.pixelAspectRatio(); aspect != 1)
        image.attributes[kPixelAspect] = fmt::format("{}", aspect);
    for (auto a = header.begin(); a != header.end(); ++a) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        if (text && !is_of_format(a.name(), has_parts))
            image.attributes.emplace(a.name(), text->value());
    }
}

double channel_bytes(const ExrHeader& header) {
    return 4.0 * double(header.channels.size()) * header.width * header.height;
}

}  // namespace

bool fits_memory(const ExrHeader& header) {
    return has_room_for(channel_bytes(header));
}

ExrHeader read_exr_header(const std::filesystem::path& path) {
    const InputFile file(path);  // reports what is wrong with the file itself
    check_exr_header(file);
    return ExrHeaderReader(file, path).read();
}

Image read_exr(const std::filesystem::path& path) {
    const InputFile file(path);
    check_exr_header(file);
    const ExrHeaderReader reader(file, path);
    const ExrHeader header = reader.read();
    check_size(file, header);
    reader.check_chunks();
    require_room(path, fmt::format("an image of {}x{} pixels", header.width, header.height),
                 channel_bytes(header));
    const std::vector<ExrChannel> channels = reader.channels();
    try {
        Imf::MultiPartInputFile input(path.c_str());
        Image image;
        image.width = header.width;
        image.height = header.height;
        set_place(input.header(0), image);
        for (int part = 0; part < input.parts(); ++part) {
            if (part > 0 && !header.parts.at(size_t(part)).is_read) continue;
            if (!input.partComplete(part)) file.refuse("rows are missing; the file is truncated");
            read_part(file, input, part, channels, image);
            add_texts(input.header(part), input.parts() > 1, image);
        }
        return image;
    } catch (const Iex::BaseExc& error) {
        file.refuse(fmt::format("not a readable OpenEXR file: {}", error.what()));
    }
}

}  // namespace voxelume
