// SPDX-License-Identifier: Apache-2.0
// Deep scanline OpenEXR of voxelume -> volumetric image.
#include <ImfChannelList.h>
#include <ImfDeepFrameBuffer.h>
#include <ImfDeepScanLineInputFile.h>
#include <ImfHeader.h>
#include <ImfInputFile.h>
#include <ImfStringAttribute.h>

#include <algorithm>
#include <cmath>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image/exr_header_check.hpp"
#include "runtime/io/volume/volume_exr.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume {

namespace {

using volume_exr::kIdChannels;
using volume_exr::kReadChannels;

/// A sample before the voxels are sorted by `index`.
struct Sample {
    uint64_t index = 0;
    glm::vec3 color{0};
    float opacity = 0, depth = 0;
    uint32_t object = 0;
    VoxelKind kind = VoxelKind::space;
};

/// One row of pixels. The pointers of all its pixels lead into shared buffers, one a channel.
struct DeepRow {
    explicit DeepRow(size_t pixels) : counts(pixels) {
        for (auto& list : float_pointers) list.resize(pixels);
        for (auto& list : id_pointers) list.resize(pixels);
    }
    /// Allocates memory for the samples of `counts`.
    void make_room() {
        size_t total = 0;
        for (const uint32_t count : counts) total += count;
        for (auto& samples : floats) samples.resize(total);
        for (auto& samples : ids) samples.resize(total);
        size_t first = 0;
        for (size_t pixel = 0; pixel < counts.size(); first += counts[pixel++]) {
            for (size_t c = 0; c < floats.size(); ++c)
                float_pointers[c][pixel] = floats[c].data() + first;
            for (size_t c = 0; c < ids.size(); ++c) id_pointers[c][pixel] = ids[c].data() + first;
        }
    }

    std::vector<uint32_t> counts;
    std::array<std::vector<float>, kReadChannels.size()> floats;
    std::array<std::vector<uint32_t>, kIdChannels.size()> ids;
    std::array<std::vector<float*>, kReadChannels.size()> float_pointers;
    std::array<std::vector<uint32_t*>, kIdChannels.size()> id_pointers;
};

Imf::DeepFrameBuffer frame_buffer(DeepRow& row) {
    Imf::DeepFrameBuffer buffer;
    buffer.insertSampleCountSlice(
        Imf::Slice(Imf::UINT, reinterpret_cast<char*>(row.counts.data()), sizeof(uint32_t), 0));
    for (size_t c = 0; c < kReadChannels.size(); ++c)
        buffer.insert(
            kReadChannels[c],
            Imf::DeepSlice(Imf::FLOAT, reinterpret_cast<char*>(row.float_pointers[c].data()),
                           sizeof(float*), 0, sizeof(float)));
    for (size_t c = 0; c < kIdChannels.size(); ++c)
        buffer.insert(kIdChannels[c],
                      Imf::DeepSlice(Imf::UINT, reinterpret_cast<char*>(row.id_pointers[c].data()),
                                     sizeof(uint32_t*), 0, sizeof(uint32_t)));
    return buffer;
}

/// Makes a voxel of a sample. Where the opacity is 0, a deep image keeps only its product with the
/// colour, so the colour is lost.
Sample take_sample(const InputFile& readable, const VolumeFrame& frame, const DeepRow& row,
                   uint64_t pixel, size_t i) {
    const uint32_t k = row.ids[2][i], kind = row.ids[1][i];
    if (k >= uint32_t(frame.size.z) || kind > 2) readable.refuse("a sample is no display voxel");
    const uint64_t pixels = uint64_t(frame.size.x) * uint64_t(frame.size.y);
    Sample sample{pixel + pixels * k};
    sample.opacity = row.floats[3][i];
    sample.color = {row.floats[0][i], row.floats[1][i], row.floats[2][i]};
    if (sample.opacity > 0) sample.color /= sample.opacity;
    sample.depth = row.floats[4][i];
    sample.object = row.ids[0][i];
    sample.kind = static_cast<VoxelKind>(kind);
    return sample;
}

std::vector<Sample> read_rows(const InputFile& readable, const VolumeFrame& frame,
                              Imf::DeepScanLineInputFile& input) {
    const auto width = uint64_t(frame.size.x);
    DeepRow row(width);
    std::vector<Sample> samples;
    input.setFrameBuffer(frame_buffer(row));
    for (int y = 0; y < frame.size.y; ++y) {
        input.readPixelSampleCounts(y, y);
        const auto is_deeper = [&](uint32_t count) { return count > uint32_t(frame.size.z); };
        if (std::ranges::any_of(row.counts, is_deeper))
            readable.refuse("a pixel has more samples than the display has steps");
        row.make_room();
        input.readPixels(y, y);
        size_t i = 0;
        for (uint64_t x = 0; x < width; ++x)
            for (uint32_t n = 0; n < row.counts[x]; ++n)
                samples.push_back(take_sample(readable, frame, row, uint64_t(y) * width + x, i++));
    }
    std::ranges::sort(samples, {}, &Sample::index);
    return samples;
}

VolumeFrame take_frame(const InputFile& readable, const VolumePath& path,
                       const Imf::Header& header) {
    const auto* text = header.findTypedAttribute<Imf::StringAttribute>(kFrameKey);
    if (text == nullptr) readable.refuse("a deep image, but not of a display");
    const VolumeFrame frame = read_frame_text(text->value(), path.string());
    const Imath::Box2i& window = header.dataWindow();
    if (window.min != Imath::V2i(0) || window.max.x != frame.size.x - 1 ||
        window.max.y != frame.size.y - 1)
        readable.refuse("its size isn't the display's");
    for (const char* name : kReadChannels)
        if (header.channels().findChannel(name) == nullptr)
            readable.refuse(fmt::format("it has no channel {}", name));
    return frame;
}

Volume take_volume(const InputFile& readable, const VolumePath& path) {
    Imf::DeepScanLineInputFile input(path.c_str());
    if (!input.isComplete()) readable.refuse("rows are missing; the file is truncated");
    Volume volume;
    const Imf::Header& header = input.header();
    volume.frame = take_frame(readable, path, header);
    for (auto a = header.begin(); a != header.end(); ++a) {
        const auto* text = dynamic_cast<const Imf::StringAttribute*>(&a.attribute());
        const std::string name = a.name();
        if (text != nullptr && name != kFrameKey && name != volume_exr::kChecksumKey &&
            name != "type")
            volume.attributes[name] = text->value();
    }
    for (const Sample& sample : read_rows(readable, volume.frame, input)) {
        volume.indices.push_back(sample.index);
        volume.colors.push_back(sample.color);
        volume.opacities.push_back(sample.opacity);
        volume.depths.push_back(sample.depth);
        volume.objects.push_back(sample.object);
        volume.kinds.push_back(sample.kind);
    }
    return volume;
}

}  // namespace

Volume read_volume_exr(const VolumePath& path) {
    const InputFile readable(path);
    // OpenEXR 3.1.5 writes past its memory for some damaged deep files, so it reads only files that
    // are unchanged since they were written.
    const uint64_t offset = volume_exr::find_checksum(readable);
    if (offset == 0) readable.refuse("not a deep image of voxelume: it has no checksum");
    std::string checksum(volume_exr::kChecksumDigits, '\0');
    readable.read(offset, checksum.data(), checksum.size());
    if (checksum != volume_exr::compute_checksum(readable, offset))
        readable.refuse("damaged, or changed by another program: its checksum differs");
    check_exr_header(readable);
    try {
        return take_volume(readable, path);
    } catch (const Iex::BaseExc& error) {
        readable.refuse(fmt::format("not a readable OpenEXR file: {}", error.what()));
    }
}

}  // namespace voxelume
