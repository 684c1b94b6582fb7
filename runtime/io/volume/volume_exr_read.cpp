// SPDX-License-Identifier: Apache-2.0
// Deep scanline OpenEXR of voxelume -> volumetric image.
#include <fmt/format.h>

#include <algorithm>

#include "runtime/image/volume_geometry.hpp"
#include "runtime/io/image_codec/image_codec.hpp"
#include "runtime/io/volume/volume_exr.hpp"
#include "runtime/io/volume/volume_formats.hpp"
#include "runtime/io/volume/volume_frame_text.hpp"

namespace voxelume {

namespace {

/// A sample before the voxels are sorted by `index`.
struct Sample {
    uint64_t index = 0;
    glm::vec3 color{0};
    float opacity = 0, depth = 0;
    uint32_t object = 0;
    VoxelKind kind = VoxelKind::space;
};

/// Makes a voxel of a sample. Where the opacity is 0, a deep image keeps only its product with the
/// colour, so the colour is lost.
Sample take_sample(const InputFile& readable, const VolumeFrame& frame, const DeepExrRow& row,
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

std::vector<Sample> read_rows(const InputFile& readable, const VolumeFrame& frame) {
    const auto width = uint64_t(frame.size.x);
    std::vector<Sample> samples;
    const auto take = [&](int y, const DeepExrRow& row) {
        size_t i = 0;
        for (uint64_t x = 0; x < width; ++x)
            for (uint32_t n = 0; n < row.counts[x]; ++n)
                samples.push_back(take_sample(readable, frame, row, uint64_t(y) * width + x, i++));
    };
    if (decodes_apart())
        ask_deep_exr(readable, {frame.size.x, frame.size.y}, uint32_t(frame.size.z), take);
    else
        decode_deep_exr(readable, uint32_t(frame.size.z), take);
    std::ranges::sort(samples, {}, &Sample::index);
    return samples;
}

VolumeFrame take_frame(const InputFile& readable, const VolumePath& path,
                       const DeepExrHeader& header) {
    const auto text = header.texts.find(kFrameKey);
    if (text == header.texts.end()) readable.refuse("a deep image, but not of a display");
    VolumeFrame frame = read_frame_text(text->second, path.string());
    if (header.first != glm::ivec2(0) || header.size != glm::ivec2(frame.size))
        readable.refuse("its size isn't the display's");
    for (const char* name : kDeepFloatChannels)
        if (!header.channels.contains(name))
            readable.refuse(fmt::format("it has no channel {}", name));
    return frame;
}

Volume take_volume(const InputFile& readable, const VolumePath& path) {
    const DeepExrHeader header =
        decodes_apart() ? ask_deep_exr_header(readable) : decode_deep_exr_header(readable);
    Volume volume;
    volume.frame = take_frame(readable, path, header);
    for (const auto& [name, text] : header.texts)
        if (name != kFrameKey && name != volume_exr::kChecksumKey && name != "type")
            volume.attributes[name] = text;
    for (const Sample& sample : read_rows(readable, volume.frame)) {
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
    return take_volume(readable, path);
}

}  // namespace voxelume
