// SPDX-License-Identifier: Apache-2.0
#include "runtime/io/image_codec/deep_exr_decoder.hpp"

#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputPart.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>  // the linter takes its forward declaration for our class
#include <ImfMultiPartInputFile.h>
#include <ImfStringAttribute.h>
#include <fmt/format.h>

#include <algorithm>
#include <numeric>

#include "runtime/io/image_codec/exr_header_check.hpp"
#include "runtime/io/image_codec/exr_input.hpp"

namespace voxelume {
namespace {

/// A row, and OpenEXR's pointers to the samples of each pixel.
class RowBuffer {
  public:
    explicit RowBuffer(size_t pixels) {
        row_.counts.resize(pixels);
        for (auto& list : float_pointers_) list.resize(pixels);
        for (auto& list : id_pointers_) list.resize(pixels);
    }

    /// A frame buffer whose every row is this one: its stride is zero.
    Imf::DeepFrameBuffer frame_buffer() {
        Imf::DeepFrameBuffer buffer;
        buffer.insertSampleCountSlice(Imf::Slice(
            Imf::UINT, reinterpret_cast<char*>(row_.counts.data()), sizeof(uint32_t), 0));
        for (size_t c = 0; c < kDeepFloatChannels.size(); ++c)
            buffer.insert(
                kDeepFloatChannels[c],
                Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(float_pointers_[c].data()),
                               sizeof(float*), 0, sizeof(float)));
        for (size_t c = 0; c < kDeepIdChannels.size(); ++c)
            buffer.insert(kDeepIdChannels[c],
                          Imf::DeepSlice(Imf::UINT, reinterpret_cast<char*>(id_pointers_[c].data()),
                                         sizeof(uint32_t*), 0, sizeof(uint32_t)));
        return buffer;
    }
    /// Allocates memory for the samples that are counted.
    void make_room() {
        const uint64_t total = row_.samples();
        for (auto& samples : row_.floats) samples.resize(total);
        for (auto& samples : row_.ids) samples.resize(total);
        size_t first = 0;
        for (size_t pixel = 0; pixel < row_.counts.size(); first += row_.counts[pixel++]) {
            for (size_t c = 0; c < row_.floats.size(); ++c)
                float_pointers_[c][pixel] = row_.floats[c].data() + first;
            for (size_t c = 0; c < row_.ids.size(); ++c)
                id_pointers_[c][pixel] = row_.ids[c].data() + first;
        }
    }
    const DeepExrRow& row() const { return row_; }

  private:
    DeepExrRow row_;
    std::array<std::vector<float*>, kDeepFloatChannels.size()> float_pointers_;
    std::array<std::vector<uint32_t*>, kDeepIdChannels.size()> id_pointers_;
};

/// Calls `read` with OpenEXR's reader of the file. Its errors become ours.
template <class Read>
auto with_part(const InputFile& file, const Read& read) {
    check_exr_header(file);
    try {
        ExrInput stream(file);
        Imf::MultiPartInputFile input(stream);
        return read(input);
    } catch (const Iex::BaseExc& error) {
        file.refuse(fmt::format("not a readable OpenEXR file: {}", error.what()));
    }
}

}  // namespace

uint64_t DeepExrRow::samples() const {
    return std::accumulate(counts.begin(), counts.end(), uint64_t{0});
}

DeepExrHeader decode_deep_exr_header(const InputFile& file) {
    return with_part(file, [&](Imf::MultiPartInputFile& input) {
        const Imf::DeepScanLineInputPart part(input, 0);  // throws for other layouts
        if (!input.partComplete(0)) file.refuse("rows are missing; the file is truncated");
        const Imf::Header& header = part.header();
        const Imath::Box2i& window = header.dataWindow();
        const Imath::V2i size = window.size();
        DeepExrHeader found{{window.min.x, window.min.y}, {size.x + 1, size.y + 1}, {}, {}};
        const Imf::ChannelList& channels = header.channels();
        for (auto c = channels.begin(); c != channels.end(); ++c) found.channels.insert(c.name());
        for (auto a = header.begin(); a != header.end(); ++a)
            if (const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute()))
                found.texts[a.name()] = text->value();
        return found;
    });
}

void decode_deep_exr(const InputFile& file, uint32_t max_samples, const TakeDeepExrRow& take) {
    with_part(file, [&](Imf::MultiPartInputFile& input) {
        Imf::DeepScanLineInputPart part(input, 0);
        const Imath::Box2i& window = part.header().dataWindow();
        RowBuffer buffer(size_t(window.size().x) + 1);
        part.setFrameBuffer(buffer.frame_buffer());
        for (int y = window.min.y; y <= window.max.y; ++y) {
            part.readPixelSampleCounts(y, y);
            const auto is_deeper = [&](uint32_t count) { return count > max_samples; };
            if (std::ranges::any_of(buffer.row().counts, is_deeper))
                file.refuse("a pixel has more samples than the display has steps");
            buffer.make_room();
            part.readPixels(y, y);
            take(y - window.min.y, buffer.row());
        }
    });
}

}  // namespace voxelume
