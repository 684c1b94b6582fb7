// SPDX-License-Identifier: Apache-2.0
#include <ImfChannelList.h>
#include <ImfFrameBuffer.h>
#include <ImfHeader.h>
#include <ImfInputPart.h>
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <iterator>

#include "runtime/io/image_codec/exr_header.hpp"
#include "runtime/io/image_codec/exr_header_check.hpp"
#include "runtime/io/image_codec/exr_input.hpp"

namespace voxelume {

namespace {

/// The maximum of pixel bytes per file byte. No compression of OpenEXR reaches it, so a header
/// beyond it is false, and no memory is allocated for it.
constexpr uint64_t kLargestRatio = 4096;

/// Refuses a part of another size than `image`, and channels that are missing or subsampled.
void check_part(const InputFile& file, const Imf::Header& header,
                const std::vector<ExrChannel>& channels, const ExrHeader& image) {
    if (header.dataWindow().size() != Imath::V2i(image.width - 1, image.height - 1))
        file.refuse("not a readable OpenEXR file: its data windows differ");
    for (const ExrChannel& channel : channels) {
        const Imf::Channel* found = header.channels().findChannel(channel.own);
        if (!found) file.refuse(fmt::format("channel {} is missing", channel.own));
        if (found->xSampling != 1 || found->ySampling != 1)
            file.refuse(
                fmt::format("channel {} is subsampled, which voxelume doesn't read", channel.name));
    }
}

/// Reads the rows of a part, which has these channels.
void read_part(Imf::InputPart part, const std::vector<ExrChannel>& channels, ExrSink& sink) {
    const Imath::Box2i window = part.header().dataWindow();
    const int height = window.size().y + 1;
    const int step = std::max(sink.rows_at_once(), 1);
    for (int first = 0; first < height;) {
        const int count = std::min(step, height - first);
        Imath::Box2i rows = window;
        rows.min.y += first;
        rows.max.y = rows.min.y + count - 1;
        Imf::FrameBuffer buffer;
        for (const ExrChannel& channel : channels)
            buffer.insert(channel.own,
                          Imf::Slice::Make(channel.type == EXR_PIXEL_UINT ? Imf::UINT : Imf::FLOAT,
                                           sink.room(channel.name, first, count), rows));
        part.setFrameBuffer(buffer);
        part.readPixels(rows.min.y, rows.max.y);
        sink.take_rows();
        first += count;
    }
}

/// The channels that are in a part.
std::vector<ExrChannel> channels_in(int part, const std::vector<ExrChannel>& channels) {
    std::vector<ExrChannel> own;
    std::ranges::copy_if(channels, std::back_inserter(own),
                         [&](const ExrChannel& channel) { return channel.part == part; });
    return own;
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

}  // namespace

ExrHeader decode_exr_header(const InputFile& file) {
    check_exr_header(file);
    return ExrHeaderReader(file).read();
}

void check_exr_size(const InputFile& file, const ExrHeader& header) {
    if (header.layout.starts_with("deep"))
        file.refuse("is a deep image, and a flat one is needed here");
    const uint64_t pixels =
        static_cast<uint64_t>(header.width) * static_cast<uint64_t>(header.height);
    if (pixels / kLargestRatio * header.channels.size() > file.size())
        file.refuse(
            fmt::format("declares {} x {} pixels and is far too small for them; it is damaged",
                        header.width, header.height));
}

Image decode_exr(const InputFile& file, ExrSink& sink) {
    check_exr_header(file);
    const ExrHeaderReader reader(file);
    const ExrHeader header = reader.read();
    check_exr_size(file, header);
    reader.check_chunks();
    sink.begin(header);
    const std::vector<ExrChannel> channels = reader.channels();
    try {
        ExrInput stream(file);
        Imf::MultiPartInputFile input(stream);
        Image image;
        image.width = header.width;
        image.height = header.height;
        set_place(input.header(0), image);
        for (int part = 0; part < input.parts(); ++part) {
            if (part > 0 && !header.parts.at(size_t(part)).is_read) continue;
            if (!input.partComplete(part)) file.refuse("rows are missing; the file is truncated");
            const std::vector<ExrChannel> own = channels_in(part, channels);
            check_part(file, input.header(part), own, header);  // before memory for it is taken
            read_part(Imf::InputPart(input, part), own, sink);
            add_texts(input.header(part), input.parts() > 1, image);
        }
        return image;
    } catch (const Iex::BaseExc& error) {
        file.refuse(fmt::format("not a readable OpenEXR file: {}", error.what()));
    }
}

}  // namespace voxelume
